// Fluid that touches no wall, coarse.
#include "support/gpu_test.h"
#include "validation/free_motion.h"

namespace meltpoint::validation {
namespace {

class FreeMotions : public GpuTest {
protected:
    static Host host() { return {.context = context()}; }
};

TEST_F(FreeMotions, FallAsGravityHasIt)
{
    const Fall fall = measure_fall(host(), {.across = 4});
    EXPECT_LE(fall.speed, 1e-5);
    EXPECT_LE(fall.place, 1e-5);
    for (const Solver solver : {Solver::Dfsph, Solver::Pbf}) {
        const Fall solved = measure_fall(host(), {.solver = solver, .across = 4});
        EXPECT_LE(solved.speed, 1e-5);
        EXPECT_NEAR(solved.ahead, 0.5, 0.05);
    }
    EXPECT_GT(measure_fall(host(), {.across = 4, .gravity_factor = 1.2}).place, 0.1);
}

TEST_F(FreeMotions, KeepMomentumWhenDropsMeet)
{
    for (const Solver solver : {Solver::Wcsph, Solver::Dfsph, Solver::Pbf}) {
        SCOPED_TRACE(static_cast<int>(solver));
        const Encounter encounter = measure_encounter(host(), {.solver = solver, .across = 6});
        EXPECT_LE(encounter.momentum, 1e-6);
        EXPECT_LE(encounter.angular_momentum, solver == Solver::Pbf ? 0.01 : 2e-6);
        EXPECT_GE(encounter.exchanged, 0.2);
    }
}

} // namespace
} // namespace meltpoint::validation
