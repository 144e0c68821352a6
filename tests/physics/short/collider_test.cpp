// Colliders one particle thick on the GPU.
#include "run/fluid_settings.h"
#include "run/scene_particles.h"
#include "support/fluid_box.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class Collider : public GpuTest {};

constexpr float level = 5.0f * test_spacing; // m, of the plate
constexpr float uneven = 0.3f;
constexpr float plate_spacing = 0.75f * test_spacing;

/// A plate across a box of 16 x 26 x 16 spacings.
ParticleSet add_plate_to(ParticleSet set)
{
    add_plate(set, 16.0f * test_spacing, level, plate_spacing, uneven, 1);
    return set;
}

sim::SimulationSettings plate_settings(std::uint32_t kernel, double speed)
{
    return box_settings(kernel, 2.0, {16, 26, 16}, speed, kernel == shared::KERNEL_PAPER ? 2.0 : 0.1);
}

/// Of the fluid.
struct Seen {
    std::size_t below = 0; ///< the plate
    double momentum_x = 0.0;
    double highest_speed = 0.0;
};

Seen look_at(const ParticleSet& set)
{
    Seen seen;
    for (std::size_t i = 0; i < set.size(); ++i) {
        if (!shared::is_boundary(set.attributes[i])) {
            seen.below += set.position[i].y < level ? 1 : 0;
            seen.momentum_x += static_cast<double>(set.mass[i] * set.velocity[i].x);
            seen.highest_speed = std::max(seen.highest_speed, static_cast<double>(glm::length(set.velocity[i])));
        }
    }
    return seen;
}

// Falls 8 spacings onto an uneven plate at the scene's CFL bound.
TEST_F(Collider, APlateOneParticleThickDoesNotLeak)
{
    for (const std::uint32_t kernel : {shared::KERNEL_WENDLAND, shared::KERNEL_PAPER}) {
        const double height = 16 * static_cast<double>(test_spacing);
        const sim::SimulationSettings settings = plate_settings(kernel, std::sqrt(2.0 * test_gravity * height));
        const ParticleSet start = add_plate_to(lattice_state({8, 8, 8}, test_spacing * glm::vec3(4.5f, 13.5f, 4.5f)));
        sim::Simulation simulation(context(), start, settings);
        const double energy = mechanical_energy(start, settings);
        double lowest = energy;
        for (int i = 0; i < 12; ++i) {
            simulation.advance(steps_for(0.05, settings));
            const ParticleSet set = simulation.download();
            const Seen seen = look_at(set);
            EXPECT_EQ(seen.below, 0u) << "kernel " << kernel << ", t = " << simulation.time();
            if (kernel == shared::KERNEL_WENDLAND) { // the other has no energy to keep
                EXPECT_LE(mechanical_energy(set, settings), lowest + 0.01 * energy) << "t = " << simulation.time();
                lowest = std::min(lowest, mechanical_energy(set, settings));
            }
        }
        const ParticleSet end = simulation.download();
        for (std::size_t i = 512; i < end.size(); ++i) {
            ASSERT_EQ(end.position[i], start.position[i]);
            ASSERT_EQ(end.velocity[i], glm::vec3(0.0f));
        }
    }
}

/// A tank of 16 x 24 x 16 spacings with nothing in it yet. Its colliders are sampled as coarsely as a scene may ask.
Scene tank(SphKernel kernel)
{
    Scene scene;
    scene.name = "tank";
    scene.kernel = kernel;
    scene.domain.min = glm::vec3(0.0f);
    scene.domain.max = test_spacing * glm::vec3(16.0f, 24.0f, 16.0f);
    scene.particles.spacing = test_spacing;
    scene.physics.viscosity = kernel == SphKernel::Paper ? 2.0f : 0.1f;
    return scene;
}

constexpr float coarsest = 0.75f; // spacings

/// How many fluid particles `has_leaked` says so of, at any of ten moments in 0.5 s, with the scene's own time steps.
template <class HasLeaked>
std::size_t count_leaks(const gpu::Context& context, const Scene& scene, const HasLeaked& has_leaked)
{
    const ParticleSet start = make_particles(scene, 1'000'000);
    const FluidSettings settings = fluid_settings(scene, start);
    sim::Simulation simulation(context, start, settings.simulation);
    std::size_t leaks = 0;
    for (int i = 0; i < 10; ++i) {
        simulation.advance_by(0.05);
        const ParticleSet set = simulation.download();
        for (std::size_t p = 0; p < set.size(); ++p) {
            leaks += !shared::is_boundary(set.attributes[p]) && has_leaked(set.position[p]) ? 1 : 0;
        }
    }
    return leaks;
}

// A block falls 8 spacings onto a plate of blue noise, as scenes have it.
TEST_F(Collider, ASampledPlateDoesNotLeak)
{
    for (const SphKernel kernel : {SphKernel::Wendland, SphKernel::Paper}) {
        Scene scene = tank(kernel);
        scene.fluids.push_back(
            {.shape = BlockShape{test_spacing * glm::vec3(4, 13, 4), test_spacing * glm::vec3(12, 21, 12)}});
        scene.colliders.push_back(
            {.shape = BlockShape{{0.0f, level, 0.0f}, {scene.domain.max.x, level, scene.domain.max.z}},
             .spacing = coarsest});
        EXPECT_EQ(count_leaks(context(), scene, [](const glm::vec3& x) { return x.y < level; }), 0u);
    }
}

// At 5 m/s, in both solvers: onto a plate one particle thick, and onto a solid ball that the fluid flows around.
TEST_F(Collider, NothingLeaksThroughWhatIsHitAtFiveMetersASecond)
{
    for (const Solver solver : {Solver::Wcsph, Solver::Dfsph}) {
        SCOPED_TRACE(solver == Solver::Dfsph ? "dfsph" : "wcsph");
        Scene scene = tank(SphKernel::Wendland);
        scene.solver = solver;
        scene.physics.viscosity = solver == Solver::Dfsph ? 0.001f : 0.1f;
        scene.fluids.push_back(
            {.shape = BlockShape{test_spacing * glm::vec3(4, 14, 4), test_spacing * glm::vec3(12, 22, 12)},
             .velocity = {0.0f, -5.0f, 0.0f}});
        Scene plate = scene;
        plate.colliders.push_back(
            {.shape = BlockShape{{0.0f, level, 0.0f}, {scene.domain.max.x, level, scene.domain.max.z}},
             .spacing = coarsest});
        EXPECT_EQ(count_leaks(context(), plate, [](const glm::vec3& x) { return x.y < level; }), 0u);

        const glm::vec3 center = test_spacing * glm::vec3(8.0f, 8.0f, 8.0f);
        const float radius = 4.0f * test_spacing;
        scene.colliders.push_back({.shape = SphereShape{center, radius}, .spacing = coarsest});
        EXPECT_EQ(count_leaks(context(), scene,
                              [&](const glm::vec3& x) {
                                  return glm::distance(x, center) < radius - 0.6f * test_spacing; // boundary particles
                              }),
                  0u);
    }
}

// A hollow ball in the air, half filled: the shell is curved, and nothing else holds the fluid.
TEST_F(Collider, AShellHoldsFluid)
{
    const float radius = 7.0f * test_spacing;
    const glm::vec3 center = test_spacing * glm::vec3(8.0f, 14.0f, 8.0f);
    for (const SphKernel kernel : {SphKernel::Wendland, SphKernel::Paper}) {
        Scene scene = tank(kernel);
        scene.fluids.push_back({.shape = BlockShape{center - test_spacing * glm::vec3(4, 5, 3),
                                                    center + test_spacing * glm::vec3(3, 1, 4)}});
        scene.colliders.push_back({.shape = SphereShape{center, radius}, .spacing = coarsest, .solid = false});
        EXPECT_EQ(count_leaks(context(), scene, [&](const glm::vec3& x) { return glm::distance(x, center) > radius; }),
                  0u);
    }
}

// A pool slides over a plate from wall to wall of a box whose other walls are open to it: nothing but friction slows
// it.
TEST_F(Collider, FrictionSlowsWhatSlides)
{
    const auto momentum_left = [&](float friction) {
        sim::SimulationSettings settings = plate_settings(shared::KERNEL_WENDLAND, 2.0);
        set_viscosity(settings.params, 100.0f); // which passes on what the plate takes
        settings.params.friction[1] = friction;
        ParticleSet set = lattice_state({6, 4, 16}, glm::vec3(0.5f, 6.1f, 0.5f) * test_spacing);
        for (glm::vec3& velocity : set.velocity) {
            velocity.x = 1.0f;
        }
        const double start = look_at(set).momentum_x;
        sim::Simulation simulation(context(), add_plate_to(set), settings);
        simulation.advance(steps_for(0.1, settings));
        return look_at(simulation.download()).momentum_x / start;
    };
    const double slippery = momentum_left(0.0f);
    const double rough = momentum_left(200.0f);
    EXPECT_GT(slippery, 0.9);
    EXPECT_LT(rough, 0.6);
    EXPECT_GT(rough, 0.0);
}

} // namespace
} // namespace meltpoint
