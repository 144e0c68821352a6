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

// Water 1 m deep with solved pressure: no sound, nothing to settle first.
TEST_F(Column, WithSolvedPressureStaysStill)
{
    constexpr std::uint32_t layers = 20;
    const double height = layers * static_cast<double>(test_spacing);
    for (const double support_ratio : {2.0, 3.0}) {
        SCOPED_TRACE(support_ratio);
        const sim::SimulationSettings water =
            solved_box_settings(support_ratio, {8, layers + 6, 8}, std::sqrt(test_gravity * height), 0.001);
        sim::Simulation simulation(context(), fluid_in_corner({8, layers, 8}), water);
        std::vector<double> energy;
        for (int i = 0; i < 100; ++i) {
            simulation.advance_by(0.1);
            const ParticleSet set = simulation.download();
            const double mass = reference::total_mass(reference::from_particle_set(set));
            energy.push_back(kinetic_energy(set) / (mass * test_gravity * height));
            EXPECT_LE(energy.back(), 1e-4) << "t = " << simulation.time();
        }
        const auto mean = [&](int first, int last) {
            return std::accumulate(energy.begin() + first, energy.begin() + last, 0.0) / (last - first);
        };
        EXPECT_LE(mean(75, 100), std::max(1.1 * mean(50, 75), 1e-6)); // no trend
    }
}

} // namespace
} // namespace meltpoint
