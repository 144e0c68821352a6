#pragma once

#include <span>
#include <string>
#include <vector>

#include "gpu/context.h"
#include "gpu/reflection.h"

namespace meltpoint::gpu {

/// Value of one specialization constant (layout(constant_id = id)).
struct SpecConstant {
    std::uint32_t id = 0;
    std::uint32_t value = 0;
};

/// As Vulkan takes them: valid as long as it and the constants are where they are.
struct Specialization {
    explicit Specialization(std::span<const SpecConstant> constants);

    std::vector<VkSpecializationMapEntry> entries;
    VkSpecializationInfo info{};
};

/// A compute shader ready to be dispatched: pipeline, layout with push descriptors, and its reflected interface.
/// Move-only.
class Kernel {
public:
    Kernel() = default;
    /// Compiles a shader from its SPIR-V. Throws as reflect, and Device when the driver fails.
    Kernel(const Context& context, const std::string& name, std::span<const std::uint32_t> spirv,
           std::span<const SpecConstant> constants = {});
    ~Kernel();
    /// Leaves the other one empty.
    Kernel(Kernel&& other) noexcept;
    /// Frees what it held and leaves the other one empty.
    Kernel& operator=(Kernel&& other) noexcept;

    /// Owned by this object.
    [[nodiscard]] VkPipeline pipeline() const { return pipeline_; }
    /// One set of push descriptors, one range of push constants.
    [[nodiscard]] VkPipelineLayout layout() const { return layout_; }
    /// Bindings and push constants, from its SPIR-V.
    [[nodiscard]] const ShaderInterface& shader() const { return shader_; }
    /// As error messages show it.
    [[nodiscard]] const std::string& name() const { return name_; }

private:
    void release() noexcept;

    const Context* context_ = nullptr;
    std::string name_;
    ShaderInterface shader_;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

/// Descriptor set layout for push descriptors with the given bindings, visible to `stages`.
[[nodiscard]] VkDescriptorSetLayout
make_push_set_layout(const Context& context, std::span<const ShaderBinding> bindings, VkShaderStageFlags stages);

/// Pipeline layout of one set and one push constant range (none when bytes is 0).
[[nodiscard]] VkPipelineLayout make_pipeline_layout(const Context& context, VkDescriptorSetLayout set_layout,
                                                    std::uint32_t push_constant_bytes, VkShaderStageFlags stages);

[[nodiscard]] VkShaderModule make_shader_module(const Context& context, std::span<const std::uint32_t> spirv);

} // namespace meltpoint::gpu
