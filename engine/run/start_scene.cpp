#include "run/start_scene.h"

#include <utility>

#include "run/fluid_settings.h"

namespace meltpoint {

StartedScene start_scene(const gpu::Context& context, const Scene& scene)
{
    SceneParticles start = make_scene_particles(scene, sim::Simulation::particle_limit(context));
    const FluidSettings settings = fluid_settings(scene, start.particles);
    StartedScene started{.simulation = std::nullopt,
                         .params = settings.simulation.params,
                         .warnings = std::move(start.notes),
                         .colliders = std::move(start.colliders)};
    started.warnings.insert(started.warnings.end(), settings.warnings.begin(), settings.warnings.end());
    if (start.particles.size() > 0) {
        started.simulation.emplace(context, start.particles, settings.simulation);
        started.params = started.simulation->params();
    }
    return started;
}

} // namespace meltpoint
