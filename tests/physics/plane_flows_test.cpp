// Flows of a plane against their exact solutions, at several resolutions.
#include "physics/plane_flows.h"
#include "physics/still_column.h"

namespace meltpoint {
namespace {

class PlaneFlows : public GpuTest {};

TEST_F(PlaneFlows, TaylorGreenVortexDecaysAtTheRightRate)
{
    for (const std::uint32_t across : {50u, 100u, 200u}) {
        const TaylorGreen::Decay decay = TaylorGreen{.across = across}.decay(context(), 0.1, 1.0);
        EXPECT_NEAR(decay.rate, 1.0, 0.05) << across;
        RecordProperty("rate_" + std::to_string(across), std::to_string(decay.rate));
    }
}

// What shifting is for: the flow draws rows of particles apart, between which there are gaps.
TEST_F(PlaneFlows, TaylorGreenVortexDecaysTooFastWithoutShifting)
{
    const TaylorGreen::Decay decay = TaylorGreen{.across = 100, .shifting = 0.0f}.decay(context(), 0.1, 1.0);
    EXPECT_GT(std::abs(decay.rate - 1.0), 0.05);
    RecordProperty("rate_without_shifting", std::to_string(decay.rate));
}

TEST_F(PlaneFlows, PoiseuilleAndCouetteHaveTheirProfiles)
{
    for (const bool couette : {false, true}) {
        for (const std::uint32_t across : {50u, 100u, 200u}) {
            EXPECT_LE((Channel{.across = across, .couette = couette}.error(context())), 0.02) << across << couette;
        }
        EXPECT_LE((Channel{.across = 50, .couette = couette, .implicit = false}.error(context())), 0.02) << couette;
    }
}

TEST_F(PlaneFlows, ColumnOfFortyLayersHasTheRightPressureAndDepth)
{
    StillColumn column(context(), 8, 40, 0.5, 2);
    column.settle();
    const StillColumn::Profile profile = column.profile(2.0, 100);
    EXPECT_LE(profile.pressure_error, 0.03);
    EXPECT_NEAR(profile.depth, column.exact_depth(), 0.01 * column.exact_depth());
    EXPECT_LE(profile.largest_energy(), 1e-4);
}

} // namespace
} // namespace meltpoint
