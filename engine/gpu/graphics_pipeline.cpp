#include "gpu/graphics_pipeline.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include <volk.h>

#include "gpu/kernel.h"

namespace meltpoint::gpu {

namespace {

constexpr VkShaderStageFlags both_stages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

/// The interface of a pipeline: every binding that one of its shaders has.
ShaderInterface merge(const ShaderInterface& a, const ShaderInterface& b)
{
    ShaderInterface merged = a;
    merged.push_constant_bytes = std::max(a.push_constant_bytes, b.push_constant_bytes);
    for (const ShaderBinding& binding : b.bindings) {
        const auto same = std::find_if(a.bindings.begin(), a.bindings.end(),
                                       [&](const ShaderBinding& other) { return other.binding == binding.binding; });
        if (same == a.bindings.end()) {
            merged.bindings.push_back(binding);
        } else if (same->type != binding.type) {
            throw std::logic_error("the shaders of a pipeline disagree about a binding's type");
        }
    }
    std::sort(merged.bindings.begin(), merged.bindings.end(),
              [](const ShaderBinding& x, const ShaderBinding& y) { return x.binding < y.binding; });
    return merged;
}

VkSampler make_nearest_sampler(const Context& context)
{
    VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    info.magFilter = VK_FILTER_NEAREST;
    info.minFilter = VK_FILTER_NEAREST;
    info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSampler sampler = VK_NULL_HANDLE;
    check(context.vk().vkCreateSampler(context.device(), &info, nullptr, &sampler), "creating a sampler");
    return sampler;
}

} // namespace

GraphicsPipeline::GraphicsPipeline(const Context& context, std::string name, const GraphicsPipelineInfo& info)
    : context_(&context), name_(std::move(name)), shader_(reflect(info.vertex))
{
    if (!info.fragment.empty()) {
        shader_ = merge(shader_, reflect(info.fragment));
    }
    std::vector<VkShaderModule> modules;
    const auto destroy_modules = [&] {
        for (const VkShaderModule module : modules) {
            context.vk().vkDestroyShaderModule(context.device(), module, nullptr);
        }
    };
    try {
        sampler_ = make_nearest_sampler(context);
        set_layout_ = make_push_set_layout(context, shader_.bindings, both_stages);
        layout_ = make_pipeline_layout(context, set_layout_, shader_.push_constant_bytes, both_stages);
        modules.push_back(make_shader_module(context, info.vertex));
        if (!info.fragment.empty()) {
            modules.push_back(make_shader_module(context, info.fragment));
        }
        create(info, modules);
    } catch (...) {
        destroy_modules();
        release();
        throw;
    }
    destroy_modules();
}

void GraphicsPipeline::create(const GraphicsPipelineInfo& info, std::span<const VkShaderModule> modules)
{
    const Specialization specialization(info.constants);
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
    for (std::size_t i = 0; i < modules.size(); ++i) {
        stages[i].sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stages[i].stage = i == 0 ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_FRAGMENT_BIT;
        stages[i].module = modules[i];
        stages[i].pName = "main";
        stages[i].pSpecializationInfo = &specialization.info;
    }
    const VkPipelineVertexInputStateCreateInfo no_input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};

    VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;

    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;

    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.cullMode = VK_CULL_MODE_NONE;
    raster.lineWidth = 1.0f;

    VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;

    const VkBool32 has_depth = info.depth_format != VK_FORMAT_UNDEFINED ? VK_TRUE : VK_FALSE;
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = has_depth;
    depth.depthWriteEnable = has_depth;
    depth.depthCompareOp = VK_COMPARE_OP_GREATER;

    VkPipelineColorBlendAttachmentState opaque{};
    opaque.colorWriteMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    const std::vector<VkPipelineColorBlendAttachmentState> attachments(info.color_formats.size(), opaque);
    VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blend.attachmentCount = static_cast<std::uint32_t>(attachments.size());
    blend.pAttachments = attachments.data();

    constexpr std::array dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = static_cast<std::uint32_t>(dynamic_states.size());
    dynamic.pDynamicStates = dynamic_states.data();

    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = static_cast<std::uint32_t>(info.color_formats.size());
    rendering.pColorAttachmentFormats = info.color_formats.data();
    rendering.depthAttachmentFormat = info.depth_format;

    VkGraphicsPipelineCreateInfo pipeline{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
    pipeline.stageCount = static_cast<std::uint32_t>(modules.size());
    pipeline.pStages = stages.data();
    pipeline.pVertexInputState = &no_input;
    pipeline.pInputAssemblyState = &assembly;
    pipeline.pViewportState = &viewport;
    pipeline.pRasterizationState = &raster;
    pipeline.pMultisampleState = &samples;
    pipeline.pDepthStencilState = &depth;
    pipeline.pColorBlendState = &blend;
    pipeline.pDynamicState = &dynamic;
    pipeline.layout = layout_;
    check(
        context_->vk().vkCreateGraphicsPipelines(context_->device(), VK_NULL_HANDLE, 1, &pipeline, nullptr, &pipeline_),
        "creating the graphics pipeline of " + name_);
    context_->set_name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline_), name_); // NOLINT
}

GraphicsPipeline::~GraphicsPipeline()
{
    release();
}

GraphicsPipeline::GraphicsPipeline(GraphicsPipeline&& other) noexcept
{
    *this = std::move(other);
}

GraphicsPipeline& GraphicsPipeline::operator=(GraphicsPipeline&& other) noexcept
{
    if (this != &other) {
        release();
        context_ = std::exchange(other.context_, nullptr);
        name_ = std::move(other.name_);
        shader_ = std::move(other.shader_);
        sampler_ = std::exchange(other.sampler_, VK_NULL_HANDLE);
        set_layout_ = std::exchange(other.set_layout_, VK_NULL_HANDLE);
        layout_ = std::exchange(other.layout_, VK_NULL_HANDLE);
        pipeline_ = std::exchange(other.pipeline_, VK_NULL_HANDLE);
    }
    return *this;
}

void GraphicsPipeline::release() noexcept
{
    if (context_ == nullptr) {
        return;
    }
    context_->vk().vkDestroyPipeline(context_->device(), pipeline_, nullptr);
    context_->vk().vkDestroyPipelineLayout(context_->device(), layout_, nullptr);
    context_->vk().vkDestroyDescriptorSetLayout(context_->device(), set_layout_, nullptr);
    context_->vk().vkDestroySampler(context_->device(), sampler_, nullptr);
}

} // namespace meltpoint::gpu
