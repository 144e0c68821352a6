// Flows of a plane against their exact solutions, coarse.
#include "physics/plane_flows.h"
#include "physics/still_column.h"

namespace meltpoint {
namespace {

class ShortPlaneFlows : public GpuTest {};

TEST_F(ShortPlaneFlows, TaylorGreenVortexDecaysAtTheRightRate)
{
    EXPECT_NEAR((TaylorGreen{.across = 40}.decay(context(), 0.1, 0.8).rate), 1.0, 0.05);
}

TEST_F(ShortPlaneFlows, PoiseuilleAndCouetteHaveTheirProfiles)
{
    for (const bool couette : {false, true}) {
        SCOPED_TRACE(couette);
        // In proportion to the spacing: twice that of the 50 across that are held to 2 %.
        EXPECT_LE((Channel{.across = 25, .couette = couette}.error(context())), 0.04);
    }
}

TEST_F(ShortPlaneFlows, ColumnHasTheRightPressureAndDepth)
{
    StillColumn column(context(), 6, 20, 0.5, 2);
    column.settle();
    const StillColumn::Profile profile = column.profile(0.5, 25);
    EXPECT_LE(profile.pressure_error, 0.06); // as in ShortColumn
    EXPECT_NEAR(profile.depth, column.exact_depth(), 0.01 * column.exact_depth());
    EXPECT_LE(profile.largest_energy(), 1e-4);
}

} // namespace
} // namespace meltpoint
