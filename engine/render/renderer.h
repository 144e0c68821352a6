#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "gpu/commands.h"
#include "gpu/draw_pass.h"
#include "render/frame.h"
#include "render/spheres.h"
#include "render/splat_quads.h"

namespace meltpoint::render {

/// Draws frames of one size. Three passes: the light's depth map, the visible surface of each sample (an index and its
/// depth), and the resolve that colors and lights each surface of a pixel once. But for spheres and lists of splats,
/// all memory is allocated by the constructor.
class Renderer {
public:
    /// A picture of width x height pixels, each averaged over samples x samples (1 to 4). Throws Input for other sample
    /// counts, Device when the size is 0, beyond the device's limits or its memory.
    Renderer(const gpu::Context& context, std::uint32_t width, std::uint32_t height, std::uint32_t samples = 2);

    /// Records a frame. The particle buffers are only read. Throws Input for a splat radius that is not positive, a
    /// light direction of length 0, a color range of width 0, or more particles or discs than an index holds (2^28) or
    /// the device fetches. Makes room for more of them than ever before; then no frame may be under way.
    void draw(gpu::Commands& commands, const Frame& frame);

    /// The picture last drawn (its commands submitted and waited for): copies it to the host and waits.
    [[nodiscard]] Image capture();

    /// Distance along the view axis, in m, of what each sample of the frame last drawn shows; infinity where that is
    /// the background or the floor. Row by row, width * samples by height * samples.
    [[nodiscard]] std::vector<float> capture_distance();

    /// Pixels.
    [[nodiscard]] std::uint32_t width() const { return width_; }
    /// Pixels.
    [[nodiscard]] std::uint32_t height() const { return height_; }

private:
    void write_params(gpu::Commands& commands, const shared::RenderParams& params);

    const gpu::Context* context_;
    std::uint32_t width_;
    std::uint32_t height_;
    std::uint32_t samples_;
    shared::SplatCamera last_camera_{};

    gpu::Image shadow_map_;
    gpu::Image visibility_;
    gpu::Image depth_;
    gpu::Image picture_;
    gpu::Image only_floor_; ///< depth of the picture: 1 where it shows the floor or the background alone
    gpu::Buffer params_;
    gpu::Buffer readback_;
    Spheres spheres_;
    QuadKernels quad_kernels_;
    std::array<SplatQuads, 2> sphere_quads_; ///< seen from the light, and by the camera
    std::array<SplatQuads, 2> disc_quads_;

    gpu::GraphicsPipeline sphere_shadow_;
    gpu::GraphicsPipeline disc_shadow_;
    gpu::GraphicsPipeline sand_shadow_;
    gpu::GraphicsPipeline sphere_;
    gpu::GraphicsPipeline disc_;
    gpu::GraphicsPipeline sand_;
    gpu::GraphicsPipeline line_;
    gpu::GraphicsPipeline floor_;
    gpu::GraphicsPipeline resolve_;
    gpu::GraphicsPipeline resolve_sand_; ///< where there is a sheet of sand
    gpu::Commands transfers_;
};

} // namespace meltpoint::render
