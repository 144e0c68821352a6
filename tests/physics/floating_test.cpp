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

} // namespace
} // namespace meltpoint
