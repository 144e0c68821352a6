#include "bench/pace.h"

#include "support/fluid_box.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class Pace : public GpuTest {};

// Over the same time, so that steps, errors and iterations can be compared.
TEST_F(Pace, IsOfTheTimeAskedFor)
{
    const double speed = 2.0;
    const sim::SimulationSettings stiff = box_settings(shared::KERNEL_WENDLAND, 2.0, {20, 20, 8}, 2.0 * speed, 1.0);
    const sim::SimulationSettings soft = box_settings(shared::KERNEL_WENDLAND, 2.0, {20, 20, 8}, speed, 1.0);
    const sim::SimulationSettings solved = solved_box_settings(2.0, {20, 20, 8}, speed, 1.0);
    const ParticleSet column = fluid_in_corner({8, 12, 8});
    const auto pace = [&](const sim::SimulationSettings& settings) {
        return bench::measure_pace(context(), column, settings, 0.3);
    };
    const bench::Pace of_stiff = pace(stiff);
    const bench::Pace of_soft = pace(soft);
    const bench::Pace of_solved = pace(solved);
    EXPECT_NEAR(of_stiff.dt, static_cast<double>(stiff.params.dt), 1e-9);
    EXPECT_NEAR(of_soft.dt, 2.0 * of_stiff.dt, 1e-8);
    EXPECT_GT(of_solved.dt, 3.0 * of_soft.dt);
    EXPECT_GT(of_soft.simulated_seconds_per_second, 0.0);
    EXPECT_EQ(of_soft.iterations, 0.0);
    EXPECT_GE(of_solved.iterations, 1.0);
    // Compression goes with 1/c0^2.
    EXPECT_NEAR(of_soft.density_error / of_stiff.density_error, 4.0, 1.5);
    EXPECT_LT(of_solved.density_error, 0.5 * of_soft.density_error);
}

} // namespace
} // namespace meltpoint
