// What an embedder writes: installed headers, the installed library, nothing of the source tree.
#include <core/error.h>
#include <core/log.h>
#include <run/fluid_settings.h>
#include <run/scene_particles.h>
#include <scene/scene_file.h>

#include <fmt/format.h>

int main()
{
    try {
        const std::vector<std::string> overrides{"particles.spacing=0.05"};
        const meltpoint::Scene scene = meltpoint::builtin_scene("teapot_drop", overrides);
        const meltpoint::ParticleSet particles = meltpoint::make_particles(scene, 1'000'000);
        const meltpoint::FluidSettings settings = meltpoint::fluid_settings(scene, particles);
        meltpoint::log_info(fmt::format("{}: {} particles, steps of {} s", scene.name, particles.size(),
                                        settings.simulation.params.dt));
    } catch (const meltpoint::Error& error) {
        meltpoint::log_error(error.what());
        return 1;
    }
    return 0;
}
