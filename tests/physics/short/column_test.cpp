// A column at rest on the GPU.
#include "support/gpu_test.h"
#include "validation/column.h"

namespace meltpoint::validation {
namespace {

class ShortColumn : public GpuTest {};

TEST_F(ShortColumn, HasTheRightPressureAndDepth)
{
    StillColumn column({.context = context()}, {.layers = 20, .width = 6});
    column.settle();
    const ColumnProfile profile = column.profile(0.5, 25);
    // Pressure ripples from layer to layer by a part of a layer's weight that does not depend on the depth: relative to
    // the whole it is twice as large in 20 layers as in the 40 that are held to 3 %.
    EXPECT_LE(profile.pressure_error, 0.06);
    EXPECT_NEAR(profile.depth, 1.0, 0.01);
    EXPECT_LE(profile.largest_energy(), 1e-4);
}

} // namespace
} // namespace meltpoint::validation
