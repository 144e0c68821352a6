#include "support/all_drivers.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class ShortLedger : public GpuTest {};

TEST_F(ShortLedger, IsExactWithAllDriversOn)
{
    expect_exact_books(context(), 900, 7);
}

} // namespace
} // namespace meltpoint
