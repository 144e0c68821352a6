// Scenes whose bodies start in each other's place, on the GPU.
#include "run/fluid_settings.h"
#include "run/frame_statistics.h"
#include "run/scene_particles.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class OverlappingStart : public GpuTest {};

FluidBody block(const glm::vec3& min, const glm::vec3& max)
{
    FluidBody body;
    body.shape = BlockShape{min, max};
    return body;
}

// Two blocks and a ball of fluid in each other, a solid ball and a plate in both. What is left has no energy but what
// gravity gives it: a density error e would kick it to about e c0.
TEST_F(OverlappingStart, IsResolvedNotExploded)
{
    Scene scene;
    scene.name = "test";
    scene.domain.min = glm::vec3(0.0f);
    scene.domain.max = glm::vec3(0.5f);
    scene.particles.spacing = 0.025f;
    scene.physics.viscosity = 0.1f;
    scene.fluids.push_back(block(glm::vec3(0.0f), {0.5f, 0.2f, 0.3f}));
    scene.fluids.push_back(block({0.013f, 0.0f, 0.12f}, {0.42f, 0.24f, 0.5f}));
    scene.fluids.push_back({.shape = SphereShape{{0.3f, 0.22f, 0.2f}, 0.1f}});
    scene.colliders.push_back({.shape = SphereShape{{0.12f, 0.1f, 0.12f}, 0.08f}});
    scene.colliders.push_back({.shape = BlockShape{{0.25f, 0.0f, 0.0f}, {0.25f, 0.15f, 0.5f}}});
    for (const SphKernel kernel : {SphKernel::Wendland, SphKernel::Paper}) {
        scene.kernel = kernel;
        scene.physics.viscosity = kernel == SphKernel::Paper ? 2.0f : 0.1f;
        const auto [start, notes, colliders] = make_scene_particles(scene, 1'000'000);
        EXPECT_EQ(notes.size(), 8u); // each fluid in both colliders, and each later one in the first
        const FluidSettings settings = fluid_settings(scene, start);
        double mass = 0.0;
        for (const float m : start.mass) {
            mass += static_cast<double>(m);
        }
        const auto speed_of_sound = static_cast<double>(settings.simulation.params.speed_of_sound);
        sim::Simulation simulation(context(), start, settings.simulation);
        for (int i = 0; i < 5; ++i) {
            simulation.advance(20);
            const FrameStatistics seen = measure(simulation.download(), simulation.params());
            const double fall = 9.81 * simulation.time(); // m/s
            EXPECT_LE(seen.kinetic_energy, 0.5 * mass * fall * fall) << "t = " << simulation.time();
            if (i == 0) { // sound has crossed 7 spacings; later on the weight of the fluid drives jets into the gaps
                EXPECT_LE(seen.fluid_part->speed_max, 0.01 * speed_of_sound + fall) << "t = " << simulation.time();
            }
        }
    }
}

} // namespace
} // namespace meltpoint
