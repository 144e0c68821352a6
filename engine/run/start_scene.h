#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gpu/context.h"
#include "run/scene_particles.h"
#include "scene/scene.h"
#include "sim/simulation.h"

namespace meltpoint {

/// What start_scene makes of a scene.
struct StartedScene {
    std::optional<sim::Simulation> simulation; ///< none in a scene of surfaces alone
    shared::SphParams params;                  ///< simulation->params(), where there is one
    std::vector<std::string> warnings;         ///< sentences: what FluidSettings and SceneParticles say
    std::vector<ColliderParticles> colliders;  ///< where the scene's are among its particles
};

/// A scene at time 0, ready to be advanced: its shapes filled with particles (make_particles), automatic values
/// resolved (fluid_settings), everything on the device. This is what run_scene steps and draws. The context must
/// outlive it. Throws Input, Device as these and Simulation do.
[[nodiscard]] StartedScene start_scene(const gpu::Context& context, const Scene& scene);

} // namespace meltpoint
