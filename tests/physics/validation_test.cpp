// Every case of `meltpoint validate`, at full size.
#include "support/gpu_test.h"
#include "validation/case.h"

namespace meltpoint {
namespace {

class Validation : public GpuTest, public testing::WithParamInterface<validation::Case> {};

TEST_P(Validation, IsWithinItsRanges)
{
    const validation::Outcome outcome = GetParam().run({.context = context()});
    EXPECT_FALSE(outcome.measurements.empty());
    for (const validation::Measurement& measurement : outcome.measurements) {
        EXPECT_TRUE(measurement.holds()) << measurement.quantity << " is " << measurement.value << ", not "
                                         << measurement.range();
    }
}

INSTANTIATE_TEST_SUITE_P(Cases, Validation, testing::ValuesIn(validation::cases().begin(), validation::cases().end()),
                         [](const auto& param) { return std::string(param.param.name); });

} // namespace
} // namespace meltpoint
