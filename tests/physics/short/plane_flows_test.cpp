// Flows of a plane against their exact solutions, coarse; and that a constant 20 % off is noticed.
#include "support/gpu_test.h"
#include "validation/channel.h"
#include "validation/column.h"
#include "validation/taylor_green.h"

namespace meltpoint::validation {
namespace {

class ShortPlaneFlows : public GpuTest {
protected:
    static Host host() { return {.context = context()}; }
};

TEST_F(ShortPlaneFlows, TaylorGreenVortexDecaysAtTheRightRate)
{
    EXPECT_NEAR(measure_decay(host(), {.across = 40}, 0.1, 0.8).rate, 1.0, 0.05);
    EXPECT_GT(measure_decay(host(), {.across = 40, .viscosity_factor = 1.2}, 0.1, 0.8).rate, 1.05);
}

TEST_F(ShortPlaneFlows, PoiseuilleAndCouetteHaveTheirProfiles)
{
    constexpr double bound = 0.04; // in proportion to the spacing: twice that of the 50 across that are held to 2 %
    for (const bool couette : {false, true}) {
        SCOPED_TRACE(couette);
        const ChannelFlow flow = measure_channel(host(), {.across = 25, .couette = couette});
        EXPECT_LE(flow.error, bound);
        EXPECT_EQ(flow.unconverged, 0u);
        EXPECT_GT(measure_channel(host(), {.across = 25, .couette = couette, .drive_factor = 1.2}).error, bound);
    }
    EXPECT_GT(measure_channel(host(), {.across = 25, .viscosity_factor = 1.2}).error, bound);
}

TEST_F(ShortPlaneFlows, ColumnHasTheRightPressureAndDepth)
{
    const auto profile = [](double gravity_factor) {
        StillColumn column(host(), {.layers = 20, .width = 6, .dimensions = 2, .gravity_factor = gravity_factor});
        column.settle();
        return column.profile(0.5, 25);
    };
    const ColumnProfile exact = profile(1.0);
    EXPECT_LE(exact.pressure_error, 0.06); // as in ShortColumn
    EXPECT_NEAR(exact.depth, 1.0, 0.01);
    EXPECT_LE(exact.largest_energy(), 1e-4);
    EXPECT_GT(profile(1.2).pressure_error, 0.06);
}

} // namespace
} // namespace meltpoint::validation
