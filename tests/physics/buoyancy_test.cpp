// Forces of fluid on colliders, at resolutions where they are right.
#include "physics/buoyancy.h"

namespace meltpoint {
namespace {

class ColliderForces : public GpuTest {};

// Archimedes: V is that of the ball as the scene has it, wherever boundary particles put its surface. What is missing
// falls with resolution.
TEST_F(ColliderForces, ABallUnderWaterIsLiftedTheBetterTheFinerItIs)
{
    for (const Solver solver : {Solver::Wcsph, Solver::Dfsph}) {
        for (const double support_ratio : {2.0, 3.0}) {
            SCOPED_TRACE(testing::Message()
                         << (solver == Solver::Dfsph ? "dfsph" : "wcsph") << ", H/d " << support_ratio);
            const Buoyancy coarse = measure_buoyancy(context(), solver, support_ratio, 4.0f);
            const Buoyancy fine = measure_buoyancy(context(), solver, support_ratio, 8.0f);
            EXPECT_NEAR(coarse.measured / coarse.exact, 1.0, 0.05);
            EXPECT_NEAR(fine.measured / fine.exact, 1.0, 0.03);
            EXPECT_LE(std::max(fine.sideways, fine.torque / 0.4), 0.02 * fine.exact);
        }
    }
}

} // namespace
} // namespace meltpoint
