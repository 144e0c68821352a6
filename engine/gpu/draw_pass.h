#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gpu/commands.h"
#include "gpu/graphics_pipeline.h"
#include "gpu/image.h"

namespace meltpoint::gpu {

/// A color image that a pass clears and draws to.
struct ColorTarget {
    const Image* image = nullptr;
    VkClearColorValue clear{};
};

/// A depth image that a pass clears and draws to. Depth is reversed: 0 is the farthest.
struct DepthTarget {
    const Image* image = nullptr;
    float clear = 0.0f;
};

/// Targets of one size; at least one of them.
struct Targets {
    std::vector<ColorTarget> colors;
    std::optional<DepthTarget> depth;
};

/// A buffer or an image that the shaders of a draw read.
struct DrawBinding {
    /// A storage, uniform or texel buffer, as the shader has it.
    DrawBinding(const Buffer& read) : buffer(&read) {} // NOLINT(google-explicit-constructor): lists read well
    /// An image, sampled.
    DrawBinding(const Image& read) : image(&read) {} // NOLINT(google-explicit-constructor)

    const Buffer* buffer = nullptr;
    const Image* image = nullptr;
};

/// One draw: triangles from `vertices` invocations of the vertex shader, bindings by binding number, all read only.
struct Draw {
    const GraphicsPipeline* pipeline = nullptr;
    std::uint32_t vertices = 0;
    std::vector<std::byte> push; ///< push constants, as push_bytes makes them
    std::vector<DrawBinding> bindings;
    const Buffer* arguments = nullptr; ///< a VkDrawIndirectCommand that says how many vertices, instead of `vertices`
};

template <class Push>
[[nodiscard]] std::vector<std::byte> push_bytes(const Push& push)
{
    const std::span<const std::byte> bytes = std::as_bytes(std::span<const Push, 1>(&push, 1));
    return {bytes.begin(), bytes.end()};
}

/// Clears the targets and runs the draws in order. Barriers and image layouts follow from targets and bindings, as in
/// Commands::dispatch. Throws std::logic_error when bindings or push constants do not match the shaders.
void record_draw_pass(Commands& commands, const Targets& targets, std::span<const Draw> draws);

} // namespace meltpoint::gpu
