#include <cstdio>
#include <meltpoint/core/error.h>
#include <meltpoint/run/frame_statistics.h>
#include <meltpoint/run/mesh_scene.h>
#include <meltpoint/run/start_scene.h>

int main(int argc, char** argv)
{
    try {
        const meltpoint::Scene scene = meltpoint::mesh_scene(argc > 1 ? argv[1] : "builtin:teapot"); // loads the mesh
        const meltpoint::gpu::Context context;
        auto started = meltpoint::start_scene(context, scene); // about 16,000 particles
        started.simulation->advance(10);
        const auto fluid = meltpoint::measure(started.simulation->download(), started.params).fluid_part.value();
        std::printf("%g %g %g\n", fluid.center_of_mass.x, fluid.center_of_mass.y, fluid.center_of_mass.z);
    } catch (const meltpoint::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
