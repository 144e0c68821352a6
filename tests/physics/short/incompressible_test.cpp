// Fluid whose pressure is solved for, in steps that the device chooses.
#include "core/random.h"
#include "support/fluid_box.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class Incompressible : public GpuTest {};

// Water as thin as it is, in steps ten times as long as those of weakly compressible SPH.
TEST_F(Incompressible, DamBreakKeepsItsVolumeAndNeverGainsEnergy)
{
    for (const double support_ratio : {2.0, 3.0}) {
        SCOPED_TRACE(support_ratio);
        const double height = 16 * static_cast<double>(test_spacing);
        const double speed = std::sqrt(2.0 * test_gravity * height);
        const sim::SimulationSettings water = solved_box_settings(support_ratio, {30, 24, 6}, speed, 0.001);
        sim::Simulation simulation(context(), fluid_in_corner({10, 16, 6}), water);
        const double start = mechanical_energy(simulation.download(), water);
        double lowest = start;
        for (int i = 0; i < 40; ++i) {
            simulation.advance_by(0.025);
            const ParticleSet set = simulation.download();
            const double energy = mechanical_energy(set, water);
            EXPECT_LE(energy, lowest + 0.01 * start) << "t = " << simulation.time();
            lowest = std::min(lowest, energy);
            EXPECT_LE(mean_density_error(set), 0.002) << "t = " << simulation.time();
            EXPECT_EQ(count_outside(set, water), 0u);
            if (simulation.time() < 0.35) { // the front arrives at 0.37 s
                EXPECT_GE(energy, 0.97 * start) << "t = " << simulation.time();
            }
        }
        EXPECT_LE(lowest, 0.9 * start); // it did break
        const auto solves = simulation.take_solve_statistics().value();
        EXPECT_EQ(solves[shared::SOLVE_DENSITY].unconverged, 0u);
        EXPECT_LE(solves[shared::SOLVE_DENSITY].worst_error, 5e-4);
        EXPECT_GE(solves[shared::SOLVE_DENSITY].mean_iterations, 1.0);
        const double wcsph_dt = 0.2 * static_cast<double>(water.params.support_radius) / (11.0 * speed);
        EXPECT_GE(simulation.time() / static_cast<double>(simulation.step()), 3.0 * wcsph_dt);
    }
}

TEST_F(Incompressible, StillWaterStaysAtRestAndBearsItsWeight)
{
    constexpr std::uint32_t layers = 12;
    const double height = layers * static_cast<double>(test_spacing);
    const sim::SimulationSettings water =
        solved_box_settings(2.0, {8, layers + 6, 8}, std::sqrt(test_gravity * height), 0.001);
    sim::Simulation simulation(context(), fluid_in_corner({8, layers, 8}), water);
    double mass = 0.0;
    for (int i = 0; i < 10; ++i) {
        simulation.advance_by(0.1);
        const ParticleSet set = simulation.download();
        mass = 0.0;
        double pressure = 0.0;
        double exact = 0.0;
        for (std::size_t k = 0; k < set.size(); ++k) {
            mass += static_cast<double>(set.mass[k]);
            pressure += static_cast<double>(set.pressure[k]);
            exact += 1000.0 * test_gravity * (height - static_cast<double>(set.position[k].y));
        }
        EXPECT_LE(kinetic_energy(set), 1e-4 * mass * test_gravity * height) << "t = " << simulation.time();
        EXPECT_NEAR(pressure / exact, 1.0, 0.1) << "t = " << simulation.time();
        EXPECT_LE(mean_density_error(set), 1e-3);
    }
}

// Of a lattice that is too dense here and there by some percent, in steps so short that to take it all away in one
// would throw it apart.
TEST_F(Incompressible, ShortStepsDoNotBlowUpUnevenFluid)
{
    constexpr double speed = 1.0;
    sim::SimulationSettings water = solved_box_settings(2.0, {20, 20, 20}, speed, 0.001);
    water.params.gravity = glm::vec3(0.0f);
    water.params.correction_time = water.params.cfl_length / static_cast<float>(speed);
    water.params.adaptive_dt = 0;
    ParticleSet set = lattice_state({10, 10, 10}, glm::vec3(5.0f * test_spacing));
    Random random(4);
    for (glm::vec3& x : set.position) {
        x += 0.1f * test_spacing * (glm::vec3(random.uniform(), random.uniform(), random.uniform()) - 0.5f);
    }
    for (const float share : {0.5f, 1e-3f}) {
        SCOPED_TRACE(share);
        water.params.dt = share * water.params.correction_time;
        sim::Simulation simulation(context(), set, water);
        double fastest = 0.0;
        for (int i = 0; i < 5; ++i) {
            simulation.advance(4);
            for (const glm::vec3& v : simulation.download().velocity) {
                fastest = std::max(fastest, static_cast<double>(glm::length(v)));
            }
        }
        EXPECT_LT(fastest, 0.5 * speed);
        EXPECT_GT(fastest, 1e-3 * speed); // it does part
    }
}

TEST_F(Incompressible, RerunsGiveTheSameBits)
{
    const sim::SimulationSettings water = solved_box_settings(2.0, {20, 20, 8}, 3.0, 0.001);
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
