// How fast viscosity stills a vortex.
#include <numbers>

#include "support/fluid_box.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class ViscousDecay : public GpuTest {};

// A vortex that fills a square of side L between walls that let it slip: v = U (sin kx cos ky, -cos kx sin ky),
// k = pi/L, dies as exp(-2 k^2 nu t) (Taylor & Green 1937). It is so slow that particles move a tenth of a spacing
// meanwhile: viscosity alone is at work, on a lattice.
TEST_F(ViscousDecay, HasTheExactRate)
{
    const std::uint32_t side = 20;
    const double viscosity = 100.0;
    const double nu = viscosity / static_cast<double>(test_rest_density);
    const double k = std::numbers::pi / (side * static_cast<double>(test_spacing));
    const double rate = 2.0 * k * k * nu;
    const double speed = 0.1 * static_cast<double>(test_spacing) * rate;
    for (const std::uint32_t kernel : {shared::KERNEL_PAPER, shared::KERNEL_WENDLAND}) {
        const double support_ratio = kernel == shared::KERNEL_PAPER ? 2.0 : 3.0;
        sim::SimulationSettings settings =
            box_settings(kernel, support_ratio, {side, side, 6}, 10.0 * speed, viscosity);
        settings.params.gravity = glm::vec3(0.0f);
        const double support_radius = static_cast<double>(settings.params.support_radius);
        settings.params.dt = static_cast<float>(0.03 * support_radius * support_radius / nu); // half the viscous bound

        ParticleSet set = fluid_in_corner({side, side, 6});
        for (std::size_t i = 0; i < set.size(); ++i) {
            const glm::dvec3 x = k * glm::dvec3(set.position[i]);
            set.velocity[i] = speed * glm::dvec3(std::sin(x.x) * std::cos(x.y), -std::cos(x.x) * std::sin(x.y), 0.0);
        }
        const double start = kinetic_energy(set);
        sim::Simulation simulation(context(), set, settings);
        simulation.advance(steps_for(1.0 / rate, settings));
        const double end = kinetic_energy(simulation.download());
        EXPECT_NEAR(0.5 * std::log(start / end) / simulation.time(), rate, 0.01 * rate) << "kernel " << kernel;
    }
}

/// The vortex of HasTheExactRate, whose viscosity is solved for, in steps of `dt`: kinetic energy at the end over that
/// at the start, after `steps`.
struct Vortex {
    std::uint32_t solver = shared::SOLVER_WCSPH;
    std::uint32_t kernel = shared::KERNEL_WENDLAND;
    double support_ratio = 3.0;
    double bounds = 1.0; ///< dt over the explicit bound
    std::uint32_t steps = 1;
};

// As implicit steps have it, each of which divides by 1 + 2 k^2 nu dt: short ones as the exact solution has it.
TEST_F(ViscousDecay, SolvedForHasTheExactRateInStepsOfAnyLength)
{
    const std::uint32_t side = 20;
    const double nu = 0.1;
    const double k = std::numbers::pi / (side * static_cast<double>(test_spacing));
    const double rate = 2.0 * k * k * nu;
    const double speed = 0.02 * static_cast<double>(test_spacing) * rate;
    for (const Vortex& vortex :
         {Vortex{.bounds = 0.5, .steps = 40}, Vortex{.bounds = 10.0, .steps = 8}, Vortex{.bounds = 100.0, .steps = 3},
          Vortex{.kernel = shared::KERNEL_PAPER, .support_ratio = 2.0, .bounds = 10.0, .steps = 8},
          Vortex{.solver = shared::SOLVER_DFSPH, .bounds = 10.0, .steps = 8},
          Vortex{.solver = shared::SOLVER_DFSPH, .support_ratio = 2.0, .bounds = 10.0, .steps = 8}}) {
        SCOPED_TRACE(testing::Message() << "solver " << vortex.solver << ", kernel " << vortex.kernel << ", H/d "
                                        << vortex.support_ratio << ", bounds " << vortex.bounds);
        sim::SimulationSettings settings = box_settings(vortex.kernel, vortex.support_ratio, {side, side, 6},
                                                        10.0 * speed, nu * static_cast<double>(test_rest_density));
        settings.options.solver = vortex.solver;
        settings.options.implicit_viscosity = true;
        settings.params.gravity = glm::vec3(0.0f);
        settings.params.viscosity_iterations = 200;
        const double support_radius = static_cast<double>(settings.params.support_radius);
        const double dt = vortex.bounds * 0.06 * support_radius * support_radius / nu;
        settings.params.dt = static_cast<float>(dt);
        // Pressure has nothing to do but to keep out of the way.
        settings.params.speed_of_sound = static_cast<float>(std::min(100.0 * speed, 0.05 * support_radius / dt));
        settings.params.density_error = settings.params.divergence_error = 0.1f;
        set_kernel_scales(settings.params, vortex.kernel, static_cast<double>(test_spacing));

        ParticleSet set = fluid_in_corner({side, side, 6});
        for (std::size_t i = 0; i < set.size(); ++i) {
            const glm::dvec3 x = k * glm::dvec3(set.position[i]);
            set.velocity[i] = speed * glm::dvec3(std::sin(x.x) * std::cos(x.y), -std::cos(x.x) * std::sin(x.y), 0.0);
        }
        const double start = kinetic_energy(set);
        sim::Simulation simulation(context(), set, settings);
        simulation.advance(vortex.steps);
        const double end = kinetic_energy(simulation.download());
        const double expected = vortex.steps * std::log(1.0 + rate * dt);
        EXPECT_NEAR(0.5 * std::log(start / end), expected, 0.015 * expected);
        EXPECT_EQ(simulation.take_viscosity_statistics().value().unconverged, 0u);
        if (vortex.bounds < 1.0) {
            EXPECT_NEAR(expected, rate * dt * vortex.steps, 0.02 * expected);
        }
    }
}

// Nothing holds a drop that spins in the air: it goes on spinning, however thick it is. The explicit model stops it.
TEST_F(ViscousDecay, SolvedForLeavesRotationAlone)
{
    const auto energy_left = [&](bool implicit) {
        sim::SimulationSettings settings = test_settings(shared::KERNEL_WENDLAND);
        settings.options.solver = shared::SOLVER_DFSPH;
        settings.options.implicit_viscosity = implicit;
        settings.params.gravity = glm::vec3(0.0f);
        settings.params.wall_mask = 0;
        set_viscosity(settings.params, 1000.0f);
        settings.params.dt = 1e-3f; // within the explicit bound of 1.35e-3 s
        const glm::vec3 center(0.5f);
        ParticleSet set = lattice_state(glm::uvec3(8), center - 3.5f * test_spacing);
        for (std::size_t i = 0; i < set.size(); ++i) {
            set.velocity[i] = glm::cross(glm::vec3(0.3f, 1.0f, -0.5f), set.position[i] - center);
        }
        const double start = kinetic_energy(set);
        sim::Simulation simulation(context(), set, settings);
        simulation.advance(100);
        return kinetic_energy(simulation.download()) / start;
    };
    EXPECT_NEAR(energy_left(true), 1.0, 0.02);
    EXPECT_LT(energy_left(false), 0.1);
}

// A block slides over a plate that rubs: both models slow it by the same, and what it loses the plate gets.
TEST_F(ViscousDecay, FrictionIsTheSameExplicitOrSolvedFor)
{
    double slowed[2] = {};
    for (const bool implicit : {false, true}) {
        SCOPED_TRACE(implicit);
        sim::SimulationSettings settings = test_settings(shared::KERNEL_WENDLAND);
        settings.options.solver = shared::SOLVER_DFSPH;
        settings.options.implicit_viscosity = implicit;
        settings.params.gravity = glm::vec3(0.0f);
        settings.params.wall_mask = 0;
        set_viscosity(settings.params, 1.0f); // thin: friction alone is to show
        settings.params.friction[1] = 200.0f;
        settings.params.dt = 1e-3f;
        ParticleSet set = lattice_state({8, 3, 8}, glm::vec3(0.25f, 0.36f, 0.3f));
        std::ranges::fill(set.velocity, glm::vec3(1.0f, 0.0f, 0.0f));
        add_plate(set, 1.0f, 0.3f, 0.75f * test_spacing, 0.3f, 3);
        const auto momentum = [](const ParticleSet& particles) {
            glm::dvec3 sum(0.0);
            for (std::size_t i = 0; i < particles.size(); ++i) {
                sum += static_cast<double>(particles.mass[i]) * glm::dvec3(particles.velocity[i]);
            }
            return sum;
        };
        const glm::dvec3 start = momentum(set);
        sim::Simulation simulation(context(), set, settings);
        simulation.measure_boundary_forces();
        simulation.advance(50);
        const auto forces = simulation.take_boundary_forces();
        glm::dvec3 on_plate(0.0);
        for (std::size_t i = 0; i < forces.friction.size(); ++i) {
            on_plate += simulation.time() * (forces.friction[i] + forces.pressure[i]);
        }
        const glm::dvec3 lost = start - momentum(simulation.download());
        EXPECT_LE(glm::length(on_plate - lost), 2e-3 * glm::length(lost));
        slowed[implicit ? 1 : 0] = lost.x / start.x;
    }
    EXPECT_GT(slowed[0], 0.1);
    EXPECT_LT(slowed[0], 0.9);
    EXPECT_NEAR(slowed[1], slowed[0], 0.03 * slowed[0]);
}

} // namespace
} // namespace meltpoint
