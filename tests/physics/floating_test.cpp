// A cube of ice floats (validation.md): its edge is 20 spacings, and the water 40 deep.
#include "support/floating.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class FloatingIce : public GpuTest {};

TEST_F(FloatingIce, DisplacesItsWeight)
{
    for (const char* solver : {"wcsph", "dfsph"}) {
        const double share = displaced_share(
            context(),
            {.solver = solver, .edge = 20, .depth = 40, .width = 40, .start = 0.9, .seconds = 2.66, .settled = 1.33});
        RecordProperty(solver, std::to_string(share));
        EXPECT_NEAR(share, 1.0, 0.05) << solver;
    }
}

TEST_F(FloatingIce, MeltsAndTheLevelStays)
{
    const double level = level_after_melting(context(), {.solver = "dfsph",
                                                         .edge = 20.586, // twenty particles of ice
                                                         .depth = 40,
                                                         .width = 40,
                                                         .start = 0.917,
                                                         .seconds = 2.66,
                                                         .settled = 1.33,
                                                         .melts = true});
    RecordProperty("level", std::to_string(level));
    EXPECT_NEAR(level, 1.0, 0.02);
}

} // namespace
} // namespace meltpoint
