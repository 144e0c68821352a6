// Water at rest, at full size and for longer.
#include <numeric>

#include "physics/still_column.h"

namespace meltpoint {
namespace {

class Column : public GpuTest {};

TEST_F(Column, OfFortyLayersHasTheRightPressureAndDepth)
{
    StillColumn column(context(), 8, 40, 0.5);
    column.settle();
    const StillColumn::Profile profile = column.profile(2.0, 100);
    EXPECT_LE(profile.pressure_error, 0.03);
    EXPECT_NEAR(profile.depth, column.exact_depth(), 0.01 * column.exact_depth());
    EXPECT_LE(profile.largest_energy(), 1e-4);
}

// Water 1 m deep for ten seconds. A lattice under its own weight is not stable: within two seconds it melts and sets
// free 2e-4 of rho g h V, which without viscosity nothing would ever take away. So the damped start lets it melt and
// settles it again.
void expect_still(StillColumn column)
{
    column.settle();
    column.run(2.5);
    column.settle();
    const StillColumn::Profile profile = column.profile(10.0, 100);
    EXPECT_LE(profile.largest_energy(), 1e-4);
    // No trend: in the first half energy finds its balance between motion and compression; from the third quarter to
    // the last it does not rise.
    const auto mean = [](auto begin, auto end) {
        return std::accumulate(begin, end, 0.0) / static_cast<double>(end - begin);
    };
    const auto& energy = profile.energy;
    EXPECT_LE(mean(energy.begin() + 75, energy.end()), 1.1 * mean(energy.begin() + 50, energy.begin() + 75));
    EXPECT_LE(profile.pressure_error, 0.06); // 20 layers, see ShortColumn
    EXPECT_NEAR(profile.depth, column.exact_depth(), 0.01 * column.exact_depth());
}

TEST_F(Column, OfViscousFluidStaysStill)
{
    expect_still(StillColumn(context(), 8, 20, 0.5));
}

TEST_F(Column, WithoutViscosityStaysStill)
{
    expect_still(StillColumn(context(), 8, 20, 0.001));
}

} // namespace
} // namespace meltpoint
