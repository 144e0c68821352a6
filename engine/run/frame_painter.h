#pragma once

#include <optional>

#include "core/image.h"
#include "render/disc_buffers.h"
#include "render/legend.h"
#include "render/renderer.h"
#include "render/solid_splats.h"
#include "scene/scene.h"
#include "sim/simulation.h"

namespace meltpoint {

/// Draws a scene as it runs: its simulation's particles where they lie, its surfaces, and its solids as splats.
class FramePainter {
public:
    /// The simulation, at its start: where it is null there are no particles. Throws as make_surface_splats,
    /// make_solid_surface and Renderer.
    FramePainter(const gpu::Context& context, const Scene& scene, const shared::SphParams& params,
                 const sim::Simulation* simulation);

    /// A frame of that simulation as it is now. Waits.
    Image paint(const sim::Simulation* simulation);

    /// How frames look, for who wants to see more of them than the scene says.
    [[nodiscard]] render::FrameSettings& settings() { return settings_; }
    [[nodiscard]] render::Renderer& renderer() { return renderer_; }

private:
    render::Renderer renderer_;
    gpu::Commands commands_;
    std::optional<render::DiscBuffers> discs_;
    std::optional<render::SolidSplats> solids_;
    std::uint32_t first_of_solids_ = 0; ///< disc
    render::FrameSettings settings_;
    std::optional<render::Legend> legend_;
};

} // namespace meltpoint
