// A small dam break on the GPU.
#include "support/fluid_box.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class SmallDamBreak : public GpuTest {};

// Almost inviscid: what feeds energy into the fluid, at walls or within, has nothing to hide behind.
TEST_F(SmallDamBreak, KeepsItsEnergyUntilItHitsTheWallAndNeverGainsAny)
{
    const double height = 16 * static_cast<double>(test_spacing);
    const sim::SimulationSettings settings =
        box_settings(shared::KERNEL_WENDLAND, 3.0, {30, 24, 6}, std::sqrt(2.0 * test_gravity * height), 0.001);
    sim::Simulation simulation(context(), fluid_in_corner({10, 16, 6}), settings);
    const double start = mechanical_energy(simulation.download(), settings);
    double lowest = start;
    for (int i = 0; i < 40; ++i) {
        simulation.advance(steps_for(0.025, settings));
        const ParticleSet set = simulation.download();
        const double energy = mechanical_energy(set, settings);
        EXPECT_LE(energy, lowest + 0.01 * start) << "t = " << simulation.time();
        lowest = std::min(lowest, energy);
        if (simulation.time() < 0.35) { // the front arrives at 0.37 s
            EXPECT_GE(energy, 0.99 * start) << "t = " << simulation.time();
            EXPECT_LE(max_density_error(set), 0.02) << "t = " << simulation.time();
        }
        EXPECT_LE(max_density_error(set), 0.1) << "t = " << simulation.time(); // where it hits the wall
        EXPECT_LE(mean_density_error(set), 0.01) << "t = " << simulation.time();
        EXPECT_EQ(count_outside(set, settings), 0u);
    }
    EXPECT_LE(lowest, 0.9 * start); // it did break
}

} // namespace
} // namespace meltpoint
