// Two dimensions and periodic axes: every pass of every solver, with every option, against its twin.
#include <algorithm>
#include <utility>

#include "conformance/pass_comparison.h"
#include "reference/measure.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

constexpr std::uint32_t both_kernels[] = {shared::KERNEL_PAPER, shared::KERNEL_WENDLAND};
constexpr std::uint32_t all_solvers[] = {shared::SOLVER_WCSPH, shared::SOLVER_DFSPH, shared::SOLVER_PBF};

void expect_all(const std::vector<conformance::PassError>& errors)
{
    for (const conformance::PassError& error : errors) {
        EXPECT_TRUE(error.conforms()) << error.pass << ": " << error.error << " > " << error.bound;
    }
}

/// Everything at once that a solver may have.
sim::SimulationSettings with_all_options(sim::SimulationSettings settings, std::uint32_t solver)
{
    settings.options.solver = solver;
    settings.options.xsph = settings.options.confinement = settings.options.tension = true;
    settings.params.xsph = 0.3f;
    settings.params.vorticity_confinement = 2.0f;
    settings.params.surface_tension = 0.5f;
    settings.params.tension_threshold = 0.5f;
    settings = with_tension(settings);
    settings.params.wall_viscosity = 20.0f;
    settings.params.lid_velocity = glm::vec3(0.7f, 0.0f, 0.0f);
    settings.params.friction[1] = 10.0f;
    settings.params.dt = solver == shared::SOLVER_WCSPH ? 2e-4f : 2e-3f;
    if (solver != shared::SOLVER_PBF) {
        settings.options.shifting = settings.options.implicit_viscosity = true;
        settings.params.shifting = 2.0f;
        set_viscosity(settings.params, 100.0f);
    }
    return settings;
}

class Plane : public GpuTest {};

TEST_F(Plane, PassesAreTheTwins)
{
    for (const std::uint32_t kernel : both_kernels) {
        for (const std::uint32_t tile : {1u, 4u}) {
            SCOPED_TRACE(testing::Message() << "kernel " << kernel << ", tile " << tile);
            sim::SimulationSettings settings = plane_settings(kernel);
            settings.options.tile = tile;
            expect_all(conformance::compare_passes(context(), plane_splash(2), settings));
            for (const std::uint32_t solver : all_solvers) {
                SCOPED_TRACE(solver);
                expect_all(conformance::compare_passes(context(), plane_splash(3), with_all_options(settings, solver)));
            }
        }
    }
}

TEST_F(Plane, WallViscosityAloneIsTheTwins)
{
    for (const std::uint32_t kernel : both_kernels) {
        SCOPED_TRACE(kernel);
        sim::SimulationSettings settings = plane_settings(kernel);
        settings.params.gravity = glm::vec3(0.0f);
        set_viscosity(settings.params, 0.0f);
        settings.params.speed_of_sound = 0.0f;
        settings.params.wall_viscosity = 2.0f;
        expect_all(conformance::compare_passes(context(), plane_splash(5), settings));
        settings.params.lid_velocity = glm::vec3(3.0f, 0.0f, 0.0f);
        expect_all(conformance::compare_passes(context(), plane_splash(5), settings));
    }
}

TEST_F(Plane, StepsAreTheTwinsAndStayInThePlane)
{
    for (const std::uint32_t solver : all_solvers) {
        SCOPED_TRACE(solver);
        sim::SimulationSettings settings = plane_settings(shared::KERNEL_WENDLAND);
        settings.options.solver = solver;
        settings.params.dt = solver == shared::SOLVER_WCSPH ? 2e-4f : 2e-3f;
        ParticleSet block = square_state({10, 8}, glm::vec2(0.5f * test_spacing));
        std::ranges::fill(block.velocity, glm::vec3(0.3f, -0.2f, 0.0f));
        sim::SimulationSettings counted = settings; // or rounding alone would decide how many iterations there are
        counted.params.density_error = counted.params.divergence_error = 0.0f;
        counted.params.least_iterations = counted.params.max_iterations = 5;
        expect_all(conformance::compare_steps(context(), block, counted, 1));
        expect_all(conformance::compare_steps(context(), block, counted, 3));
        expect_all(conformance::compare_steps(context(), block, settings, 50));

        sim::Simulation simulation(context(), block, settings);
        simulation.advance(50);
        const ParticleSet later = simulation.download();
        for (std::size_t i = 0; i < later.size(); ++i) {
            EXPECT_EQ(later.position[i].z, 0.0f);
            EXPECT_EQ(later.velocity[i].z, 0.0f);
        }
    }
}

// Fluid faster than any that a time step allows is not thrown about.
TEST_F(Plane, ShiftsAreCapped)
{
    sim::SimulationSettings settings = plane_settings(shared::KERNEL_WENDLAND);
    settings.options.shifting = true;
    settings.params.shifting = 1000.0f;
    expect_all(conformance::compare_passes(context(), plane_splash(6), settings));
}

// A square lattice that fills its box is at rest: density, and so the kernels' scales, are right.
TEST_F(Plane, LatticeIsAtRestDensity)
{
    for (const std::uint32_t kernel : both_kernels) {
        sim::SimulationSettings settings = plane_settings(kernel);
        settings.params.gravity = glm::vec3(0.0f);
        sim::Simulation simulation(context(), square_state({20, 20}, glm::vec2(0.5f * test_spacing)), settings);
        simulation.advance(20);
        const ParticleSet set = simulation.download();
        for (std::size_t i = 0; i < set.size(); ++i) {
            EXPECT_NEAR(set.density[i], test_rest_density, 1e-3f * test_rest_density);
            EXPECT_LT(glm::length(set.velocity[i]), 1e-2f);
        }
    }
}

class Periodic : public GpuTest {
protected:
    static sim::SimulationSettings settings(std::uint32_t kernel, std::uint32_t periodic_mask)
    {
        sim::SimulationSettings settings = test_settings(kernel);
        settings.params.periodic_mask = periodic_mask;
        settings.params.wall_mask = 0x3f & ~periodic_mask;
        return settings;
    }

    /// Periodic everywhere, without gravity, full of fluid that is in disorder.
    static sim::SimulationSettings closed(std::uint32_t solver)
    {
        sim::SimulationSettings closed = settings(shared::KERNEL_WENDLAND, 0x3f);
        closed.options.solver = solver;
        closed.params.gravity = glm::vec3(0.0f);
        closed.params.domain_max = glm::vec3(8 * test_spacing);
        closed.params.dt = solver == shared::SOLVER_WCSPH ? 2e-4f : 2e-3f;
        return closed;
    }

    static ParticleSet disorder()
    {
        Random random(8);
        ParticleSet set = lattice_state({8, 8, 8}, glm::vec3(0.5f * test_spacing));
        for (std::size_t i = 0; i < set.size(); ++i) {
            set.position[i] += 0.2f * test_spacing * (random_vector(random) - 0.5f);
            set.velocity[i] = 2.0f * random_vector(random) - 0.8f;
        }
        return set;
    }
};

TEST_F(Periodic, PassesAreTheTwins)
{
    for (const std::uint32_t kernel : both_kernels) {
        for (const std::uint32_t mask : {0x03u, 0x33u, 0x3fu}) {
            SCOPED_TRACE(testing::Message() << "kernel " << kernel << ", mask " << mask);
            sim::SimulationSettings some = settings(kernel, mask);
            some.options.tile = mask == 0x33u ? 1 : 4;
            expect_all(conformance::compare_passes(context(), flow_across_borders(2), some));
        }
    }
    for (const std::uint32_t solver : all_solvers) {
        SCOPED_TRACE(solver);
        const sim::SimulationSettings all = with_all_options(settings(shared::KERNEL_WENDLAND, 0x33), solver);
        expect_all(conformance::compare_passes(context(), flow_across_borders(3), all));
    }
    sim::SimulationSettings flat = plane_settings(shared::KERNEL_WENDLAND);
    flat.params.periodic_mask = 0x03;
    flat.params.wall_mask = 0x0c;
    expect_all(conformance::compare_passes(context(), in_plane(flow_across_borders(4)), flat));
}

TEST_F(Periodic, StepsAreTheTwins)
{
    for (const std::uint32_t solver : all_solvers) {
        SCOPED_TRACE(solver);
        sim::SimulationSettings counted = closed(solver);
        counted.params.density_error = counted.params.divergence_error = 0.0f;
        counted.params.least_iterations = counted.params.max_iterations = 5;
        expect_all(conformance::compare_steps(context(), disorder(), counted, 1));
        expect_all(conformance::compare_steps(context(), disorder(), counted, 3));
    }
}

TEST_F(Periodic, MomentumCrossesTheBorder)
{
    for (const std::uint32_t solver : all_solvers) {
        SCOPED_TRACE(solver);
        const sim::SimulationSettings settings = closed(solver);
        const ParticleSet start = disorder();
        sim::Simulation simulation(context(), start, settings);
        simulation.advance(100);
        const reference::State before = reference::from_particle_set(start);
        const reference::State after = reference::from_particle_set(simulation.download());
        const glm::dvec3 change = reference::momentum(after) - reference::momentum(before);
        EXPECT_LE(glm::length(change), 1e-6 * reference::momentum_magnitude(before));
        std::size_t crossed = 0;
        for (std::size_t i = 0; i < start.size(); ++i) {
            EXPECT_EQ(after.attributes[i] & shared::FLAG_LEFT_DOMAIN, 0u);
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(after.position[i], glm::dvec3(0.0))));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(after.position[i], glm::dvec3(settings.params.domain_max))));
            const double far = 0.5 * static_cast<double>(settings.params.domain_max.x);
            crossed += glm::any(glm::greaterThan(glm::abs(after.position[i] - before.position[i]), glm::dvec3(far)));
        }
        EXPECT_GT(crossed, 0u);
    }
}

// Where the borders are does not matter: the same fluid a third of the box further on does the same.
TEST_F(Periodic, NothingHappensAtTheBorder)
{
    const sim::SimulationSettings settings = closed(shared::SOLVER_WCSPH);
    const ParticleSet start = disorder();
    const float length = settings.params.domain_max.x;
    ParticleSet moved = start;
    for (glm::vec3& x : moved.position) {
        x += glm::vec3(0.33f, 0.21f, 0.47f) * length;
        x -= length * glm::floor(x / length);
    }
    sim::Simulation here(context(), start, settings);
    sim::Simulation there(context(), moved, settings);
    here.advance(50);
    there.advance(50);
    const ParticleSet a = here.download();
    const ParticleSet b = there.download();
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_LT(glm::distance(a.velocity[i], b.velocity[i]), 2e-3f);
    }
}

TEST_F(Periodic, RerunsGiveTheSameBits)
{
    for (const std::uint32_t solver : all_solvers) {
        const auto run = [&] {
            sim::Simulation simulation(context(), disorder(), closed(solver));
            simulation.advance(60);
            return simulation.download();
        };
        const ParticleSet first = run();
        const ParticleSet second = run();
        EXPECT_EQ(first.position, second.position);
        EXPECT_EQ(first.velocity, second.velocity);
    }
}

} // namespace
} // namespace meltpoint
