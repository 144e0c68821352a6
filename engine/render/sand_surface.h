#pragma once

#include <cstdint>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "render/frame.h"

namespace meltpoint::render {

/// Columns of sand of a simulation, read only.
struct SandView {
    const gpu::Buffer& view; ///< shared::VisibilityParams, of the map from above
    const gpu::Buffer&
        ground; ///< vec4 a texel; w: m above the floor of the uppermost particle, negative: there is none
    const gpu::Buffer& top_id; ///< uint a texel: who of the solids that is, 0xffffffff: none of them
    const gpu::Buffer& damage; ///< vec2 by id, two-floats: what of a particle the wind has taken
};

/// The sheet over columns of sand (shared/sand_surface.h): four passes a frame.
class SandSurface {
public:
    /// map: texels along its sides. Throws Device when its buffers do not fit.
    SandSurface(const gpu::Context& context, glm::uvec2 map);

    /// Makes the sheet, `seconds` after the last one. What of solid sand lies below it is gone in `living` (w: what is
    /// left), and `size` is that of puffs. The other buffers are those of SolidSplats.
    void record(gpu::Commands& commands, const SandView& view, const ParticleBuffers& particles,
                const gpu::Buffer& params, const gpu::Buffer& splats, const gpu::Buffer& place,
                const gpu::Buffer& living, const gpu::Buffer& size, float seconds);

    /// view: as in SandView.
    [[nodiscard]] SandSheetView sheet(const gpu::Buffer& view) const { return {view, corner_, corner_tint_, texels_}; }

private:
    std::uint32_t texels_;
    std::uint32_t corners_;
    bool first_ = true; ///< there was no frame yet
    gpu::Kernel column_kernel_;
    gpu::Kernel plane_kernel_;
    gpu::Kernel surface_kernel_;
    gpu::Kernel cover_kernel_;
    gpu::Buffer column_;      ///< vec4 a texel
    gpu::Buffer tint_;        ///< vec4 a texel
    gpu::Buffer plane_;       ///< vec4 a texel
    gpu::Buffer corner_;      ///< vec4 a corner
    gpu::Buffer corner_tint_; ///< vec4 a corner
};

} // namespace meltpoint::render
