// A loose block in water sinks in as deep as Archimedes has it: it displaces its weight.
#include "support/floating.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class FloatingTest : public GpuTest {};

TEST_F(FloatingTest, ASmallCubeDisplacesItsWeight)
{
    for (const char* solver : {"wcsph", "dfsph"}) {
        const double share = displaced_share(
            context(),
            {.solver = solver, .edge = 10, .depth = 15, .width = 20, .start = 0.9, .seconds = 1.86, .settled = 0.93});
        SCOPED_TRACE(share);
        RecordProperty(solver, std::to_string(share));
        EXPECT_NEAR(share, 1.0, 0.05) << solver;
    }
}

} // namespace
} // namespace meltpoint
