// Fluid whose positions are solved for, in steps that the device chooses.
#include "support/fluid_box.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class PositionBased : public GpuTest {
protected:
    static sim::SimulationSettings settings(double support_ratio, const glm::uvec3& box, double expected_speed)
    {
        sim::SimulationSettings settings =
            box_settings(shared::KERNEL_WENDLAND, support_ratio, box, expected_speed, 0.001);
        settings.options.solver = shared::SOLVER_PBF;
        shared::SphParams& params = settings.params;
        params.adaptive_dt = 1;
        params.cfl_length = 0.4f * test_spacing;
        params.cfl_speed = 0.0f;
        params.longest_dt = 1.0f / 120.0f; // two steps a frame
        params.longest_move = test_spacing;
        params.density_error = 0.01f;
        params.max_iterations = 60;
        return settings;
    }
};

// Of water 0.5 m high.
TEST_F(PositionBased, DamBreakNeverGainsEnergy)
{
    for (const double support_ratio : {2.0, 3.0}) {
        SCOPED_TRACE(support_ratio);
        const sim::SimulationSettings water = settings(support_ratio, {30, 20, 6}, std::sqrt(2.0 * test_gravity * 0.5));
        sim::Simulation simulation(context(), fluid_in_corner({10, 10, 6}), water);
        const double start = mechanical_energy(simulation.download(), water);
        double lowest = start;
        double farthest = 0.0;
        for (int i = 0; i < 40; ++i) {
            simulation.advance_by(0.025);
            const ParticleSet set = simulation.download();
            const double energy = mechanical_energy(set, water);
            EXPECT_LE(energy, lowest + 0.01 * start) << "t = " << simulation.time();
            lowest = std::min(lowest, energy);
            EXPECT_LE(mean_density_error(set), 0.0101) << "t = " << simulation.time();
            EXPECT_EQ(count_outside(set, water), 0u);
            const auto solve = simulation.take_solve_statistics().value()[shared::SOLVE_DENSITY];
            EXPECT_EQ(solve.unconverged, 0u);
            EXPECT_LE(solve.worst_error, 0.0101);
            EXPECT_GE(solve.mean_iterations, 1.0);
            farthest = std::max(farthest, solve.farthest_move);
        }
        EXPECT_LE(lowest, 0.9 * start); // it did break
        EXPECT_GE(lowest, 0.3 * start); // and is not syrup
        EXPECT_LE(farthest, 0.5 * static_cast<double>(test_spacing));
        EXPECT_GE(simulation.time() / static_cast<double>(simulation.step()), 3e-3);
    }
}

// The neighbors of a step are those of its predicted positions: what has come near since adds next to nothing.
TEST_F(PositionBased, DensitiesMissNoNeighborsThatMatter)
{
    sim::SimulationSettings water = settings(2.0, {30, 20, 6}, 3.0);
    sim::Simulation simulation(context(), fluid_in_corner({10, 10, 6}), water);
    for (int i = 0; i < 4; ++i) {
        simulation.advance_by(0.2);
        const ParticleSet set = simulation.download();
        sim::Simulation fresh(context(), set, water); // finds all of them
        const ParticleSet exact = fresh.download();
        double missed = 0.0;
        for (std::size_t k = 0; k < set.size(); ++k) {
            missed = std::max(missed, static_cast<double>(std::abs(exact.density[k] / set.density[k] - 1.0f)));
        }
        EXPECT_LE(missed, 1e-3) << "t = " << simulation.time();
    }
}

TEST_F(PositionBased, StillWaterStaysAndBearsItsWeight)
{
    constexpr std::uint32_t layers = 10;
    const double height = layers * static_cast<double>(test_spacing);
    const sim::SimulationSettings water = settings(2.0, {8, layers + 6, 8}, std::sqrt(test_gravity * height));
    sim::Simulation simulation(context(), fluid_in_corner({8, layers, 8}), water);
    simulation.advance_by(1.0);
    double mean_pressure = 0.0;
    for (int i = 0; i < 20; ++i) {
        simulation.advance_by(0.05);
        const ParticleSet set = simulation.download();
        double mass = 0.0;
        double pressure = 0.0;
        double exact = 0.0;
        for (std::size_t k = 0; k < set.size(); ++k) {
            mass += static_cast<double>(set.mass[k]);
            pressure += static_cast<double>(set.pressure[k]);
            exact += 1000.0 * test_gravity * (height - static_cast<double>(set.position[k].y));
        }
        EXPECT_LE(kinetic_energy(set), 1e-3 * mass * test_gravity * height) << "t = " << simulation.time();
        EXPECT_LE(mean_density_error(set), 0.0101);
        mean_pressure += pressure / exact / 20.0;
    }
    EXPECT_NEAR(mean_pressure, 1.0, 0.15);
}

// As games have it: always four iterations, and steps of half a frame, however fast the fluid.
TEST_F(PositionBased, SetIterationsInLongStepsStayInsideUnderTheSpeedCap)
{
    sim::SimulationSettings game = settings(2.0, {30, 20, 6}, 3.0);
    game.params.adaptive_dt = 0;
    game.params.dt = 1.0f / 120.0f;
    game.params.least_iterations = game.params.max_iterations = 4;
    game.params.density_error = 1e30f;
    game.params.speed_limit = 2.0f * game.params.speed_cap / game.params.dt;
    sim::Simulation simulation(context(), fluid_in_corner({10, 10, 6}), game);
    std::uint32_t capped = 0;
    for (int i = 0; i < 20; ++i) {
        simulation.advance_by(0.05);
        const ParticleSet set = simulation.download();
        EXPECT_EQ(count_outside(set, game), 0u);
        EXPECT_LE(mean_density_error(set), 0.06);
        const auto solve = simulation.take_solve_statistics().value()[shared::SOLVE_DENSITY];
        EXPECT_EQ(solve.mean_iterations, 4.0);
        EXPECT_EQ(solve.unconverged, 0u);
        capped += solve.capped;
        for (const glm::vec3& v : set.velocity) {
            EXPECT_LE(glm::length(v), 1.00001f * game.params.speed_cap / game.params.dt);
        }
    }
    EXPECT_GT(capped, 0u); // at 3 m/s
    EXPECT_LT(capped, 0.01 * static_cast<double>(simulation.step()) * 600);
}

TEST_F(PositionBased, RerunsGiveTheSameBits)
{
    const sim::SimulationSettings water = settings(2.0, {20, 20, 8}, 3.0);
    ParticleSet first;
    for (int run = 0; run < 3; ++run) {
        sim::Simulation simulation(context(), fluid_in_corner({8, 12, 8}), water);
        simulation.advance_by(0.2);
        const ParticleSet set = simulation.download();
        if (run == 0) {
            first = set;
        }
        EXPECT_EQ(set.position, first.position);
        EXPECT_EQ(set.velocity, first.velocity);
        EXPECT_EQ(set.pressure, first.pressure);
    }
}

} // namespace
} // namespace meltpoint
