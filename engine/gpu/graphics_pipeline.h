#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gpu/context.h"
#include "gpu/kernel.h"
#include "gpu/reflection.h"

namespace meltpoint::gpu {

/// What a graphics pipeline is made of. Vertices are pulled from storage buffers: there is no vertex input. Triangles,
/// no culling, no blending; depth is reversed (nearer is greater) and written where depth_format is set.
struct GraphicsPipelineInfo {
    std::span<const std::uint32_t> vertex;   ///< SPIR-V
    std::span<const std::uint32_t> fragment; ///< SPIR-V; empty where only the depth of the quads counts
    std::vector<VkFormat> color_formats;     ///< of the color targets, in order
    VkFormat depth_format = VK_FORMAT_UNDEFINED;
    std::vector<SpecConstant> constants; ///< of both shaders
};

/// A vertex and a fragment shader ready to draw: pipeline, layout with push descriptors, and the union of the two
/// shaders' interfaces. Images are read texel by texel or with nearest filtering, clamped to the edge. Move-only.
class GraphicsPipeline {
public:
    GraphicsPipeline() = default;
    /// Compiles it. Throws std::logic_error for shaders that the engine cannot bind (reflect), Device when that fails.
    GraphicsPipeline(const Context& context, std::string name, const GraphicsPipelineInfo& info);
    ~GraphicsPipeline();
    /// Leaves the other one empty.
    GraphicsPipeline(GraphicsPipeline&& other) noexcept;
    /// Frees what it held and leaves the other one empty.
    GraphicsPipeline& operator=(GraphicsPipeline&& other) noexcept;

    /// Owned by this object.
    [[nodiscard]] VkPipeline pipeline() const { return pipeline_; }
    /// One set of push descriptors, one range of push constants.
    [[nodiscard]] VkPipelineLayout layout() const { return layout_; }
    /// Nearest texel, clamped to the edge.
    [[nodiscard]] VkSampler sampler() const { return sampler_; }
    /// The union of the two shaders' bindings.
    [[nodiscard]] const ShaderInterface& shader() const { return shader_; }
    /// As error messages show it.
    [[nodiscard]] const std::string& name() const { return name_; }

private:
    void create(const GraphicsPipelineInfo& info, std::span<const VkShaderModule> modules);
    void release() noexcept;

    const Context* context_ = nullptr;
    std::string name_;
    ShaderInterface shader_;
    VkSampler sampler_ = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

} // namespace meltpoint::gpu
