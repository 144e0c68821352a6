// What an embedder writes: installed headers, the installed library, nothing of the source tree.
#include <core/error.h>
#include <core/log.h>
#include <run/fluid_settings.h>
#include <run/mesh_scene.h>
#include <run/run_scene.h>
#include <run/scene_particles.h>

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

int main()
{
    try {
        const std::vector<std::string> overrides{"particles.spacing=0.05"};
        meltpoint::Scene scene = meltpoint::find_scene("teapot_drop", overrides);
        const meltpoint::ParticleSet particles = meltpoint::make_particles(scene, 1'000'000);
        const meltpoint::FluidSettings settings = meltpoint::fluid_settings(scene, particles);
        meltpoint::log_info(fmt::format("{}: {} particles, steps of {} s", scene.name, particles.size(),
                                        settings.simulation.params.dt));

        scene.time.frames = 2;
        const meltpoint::gpu::Context context(meltpoint::gpu::ContextOptions{});
        const meltpoint::RunSummary summary = meltpoint::run_scene(context, scene, {.out = "frames", .force = true});
        return summary.frames == 2 && std::filesystem::exists("frames/frame_0001.png") ? 0 : 1;
    } catch (const meltpoint::Error& error) {
        meltpoint::log_error(error.what());
        return 1;
    }
}
