#include "support/all_drivers.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class Ledger : public GpuTest {};

TEST_F(Ledger, IsExactAtEveryStepOfTenThousandWithAllDriversOn)
{
    expect_exact_books(context(), 10'000, 1);
}

} // namespace
} // namespace meltpoint
