#include "gpu/kernel.h"

#include <utility>

#include <volk.h>

namespace meltpoint::gpu {

VkDescriptorSetLayout make_push_set_layout(const Context& context, std::span<const ShaderBinding> bindings,
                                           VkShaderStageFlags stages)
{
    std::vector<VkDescriptorSetLayoutBinding> layout_bindings;
    for (const ShaderBinding& binding : bindings) {
        layout_bindings.push_back({binding.binding, binding.type, 1, stages, nullptr});
    }
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
    info.bindingCount = static_cast<std::uint32_t>(layout_bindings.size());
    info.pBindings = layout_bindings.data();
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    check(context.vk().vkCreateDescriptorSetLayout(context.device(), &info, nullptr, &layout),
          "creating a descriptor set layout");
    return layout;
}

VkPipelineLayout make_pipeline_layout(const Context& context, VkDescriptorSetLayout set_layout,
                                      std::uint32_t push_constant_bytes, VkShaderStageFlags stages)
{
    const VkPushConstantRange range{stages, 0, push_constant_bytes};
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = 1;
    info.pSetLayouts = &set_layout;
    info.pushConstantRangeCount = push_constant_bytes > 0 ? 1 : 0;
    info.pPushConstantRanges = &range;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(context.vk().vkCreatePipelineLayout(context.device(), &info, nullptr, &layout), "creating a pipeline layout");
    return layout;
}

VkShaderModule make_shader_module(const Context& context, std::span<const std::uint32_t> spirv)
{
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = spirv.size_bytes();
    info.pCode = spirv.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(context.vk().vkCreateShaderModule(context.device(), &info, nullptr, &module), "creating a shader module");
    return module;
}

Specialization::Specialization(std::span<const SpecConstant> constants)
{
    for (std::size_t i = 0; i < constants.size(); ++i) {
        entries.push_back({constants[i].id,
                           static_cast<std::uint32_t>(i * sizeof(SpecConstant) + offsetof(SpecConstant, value)),
                           sizeof(std::uint32_t)});
    }
    info = {static_cast<std::uint32_t>(entries.size()), entries.data(), constants.size_bytes(), constants.data()};
}

Kernel::Kernel(const Context& context, const std::string& name, std::span<const std::uint32_t> spirv,
               std::span<const SpecConstant> constants)
    : context_(&context), name_(name), shader_(reflect(spirv))
{
    VkShaderModule module = VK_NULL_HANDLE;
    try {
        set_layout_ = make_push_set_layout(context, shader_.bindings, VK_SHADER_STAGE_COMPUTE_BIT);
        layout_ = make_pipeline_layout(context, set_layout_, shader_.push_constant_bytes, VK_SHADER_STAGE_COMPUTE_BIT);
        module = make_shader_module(context, spirv);
        const Specialization specialization(constants);
        VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
        info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
        info.stage.module = module;
        info.stage.pName = "main";
        info.stage.pSpecializationInfo = &specialization.info;
        info.layout = layout_;
        check(context.vk().vkCreateComputePipelines(context.device(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_),
              "creating the compute pipeline of " + name);
        context.set_name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline_), name); // NOLINT
    } catch (...) {
        context.vk().vkDestroyShaderModule(context.device(), module, nullptr);
        release();
        throw;
    }
    context.vk().vkDestroyShaderModule(context.device(), module, nullptr);
}

Kernel::~Kernel()
{
    release();
}

Kernel::Kernel(Kernel&& other) noexcept
{
    *this = std::move(other);
}

Kernel& Kernel::operator=(Kernel&& other) noexcept
{
    if (this != &other) {
        release();
        context_ = std::exchange(other.context_, nullptr);
        name_ = std::move(other.name_);
        shader_ = std::move(other.shader_);
        set_layout_ = std::exchange(other.set_layout_, VK_NULL_HANDLE);
        layout_ = std::exchange(other.layout_, VK_NULL_HANDLE);
        pipeline_ = std::exchange(other.pipeline_, VK_NULL_HANDLE);
    }
    return *this;
}

void Kernel::release() noexcept
{
    if (context_ == nullptr) {
        return;
    }
    context_->vk().vkDestroyPipeline(context_->device(), pipeline_, nullptr);
    context_->vk().vkDestroyPipelineLayout(context_->device(), layout_, nullptr);
    context_->vk().vkDestroyDescriptorSetLayout(context_->device(), set_layout_, nullptr);
}

} // namespace meltpoint::gpu
