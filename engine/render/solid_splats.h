#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "render/disc_buffers.h"
#include "render/sand_surface.h"
#include "shared/solid_splats.h"

namespace meltpoint::render {

/// Solids of a simulation, read only. What is by id is null where the scene does not have it.
struct SolidView {
    const gpu::Buffer& params;     ///< shared::SphParams
    const gpu::Buffer& cell_start; ///< of the neighbor grid, whose order the particles lie in
    const ParticleBuffers& particles;
    const gpu::Buffer* enthalpy = nullptr; ///< vec2, J/kg, two-floats
    const gpu::Buffer* damage = nullptr;   ///< vec2, two-floats
    const gpu::Buffer* freed_at = nullptr; ///< float, s
    double time = 0.0;                     ///< s, of the frame
    std::optional<SandView> sand = std::nullopt;
};

/// The splats of solids that erode (shared/solid_splats.h): four passes a frame that place them among discs. Where
/// there is sand, also the sheet over it (shared/sand_surface.h).
class SolidSplats {
public:
    /// cover: of each particle, by id, the hosted splat above it, or shared::NO_COVER. sand_map: texels along the
    /// sides of the map of sand from above; 0: there is no sand. Throws Device when its buffers do not fit.
    SolidSplats(const gpu::Context& context, const shared::SolidSplatParams& params,
                std::span<const shared::HostedSplat> hosted, std::span<const std::uint32_t> cover,
                glm::uvec2 sand_map = {0, 0});

    /// Discs that it places: one a particle, then the hosted ones.
    [[nodiscard]] std::uint32_t room() const { return pool_ + hosted_count_; }

    /// Places the discs from `first` on, of which there must be room(), and finds the size of everybody's ball, as they
    /// are at view.time, and how wet solids have become since the last call. What params.progress names must be there,
    /// and view.sand where there is sand.
    void record(gpu::Commands& commands, const SolidView& view, const DiscBuffers& discs, std::uint32_t first);

    /// Of each particle's ball, in the order they lie in: float, in radii of a particle.
    [[nodiscard]] const gpu::Buffer& size() const { return size_; }
    /// Null where there is none.
    [[nodiscard]] const SandSurface* sand() const { return sand_ ? &*sand_ : nullptr; }
    /// shared::KeptOfSolid, by id.
    [[nodiscard]] const gpu::Buffer& kept() const { return kept_; }

private:
    std::uint32_t pool_;
    std::uint32_t hosted_count_;
    double time_ = 0.0; ///< s, of the last frame
    gpu::Kernel progress_;
    gpu::Kernel particle_splat_;
    gpu::Kernel bend_splat_;
    gpu::Kernel surface_splat_;
    gpu::Buffer params_; ///< shared::SolidSplatParams
    gpu::Buffer hosted_; ///< shared::HostedSplat
    gpu::Buffer cover_;  ///< uint, by id
    gpu::Buffer living_; ///< vec4, in the particles' order
    gpu::Buffer place_;  ///< uint, by id
    gpu::Buffer size_;   ///< float, in the particles' order
    gpu::Buffer kept_;   ///< shared::KeptOfSolid, by id
    std::optional<SandSurface> sand_;
};

} // namespace meltpoint::render
