#include "validation/case.h"

#include <limits>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "support/gpu_test.h"

namespace meltpoint::validation {
namespace {

TEST(ValidationCase, AMeasurementHoldsWithinItsRange)
{
    EXPECT_TRUE(at_most("x", 0.1, 0.1).holds());
    EXPECT_FALSE(at_most("x", 0.11, 0.1).holds());
    EXPECT_TRUE(at_least("x", 3.0, 3.0).holds());
    EXPECT_FALSE(at_least("x", 2.9, 3.0).holds());
    EXPECT_TRUE(within("x", 1.0, 0.9, 1.1).holds());
    EXPECT_FALSE(within("x", 0.8, 0.9, 1.1).holds());
    EXPECT_FALSE(within("x", 1.2, 0.9, 1.1).holds());
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        EXPECT_FALSE(at_most("x", value, 0.1).holds());
    }
    EXPECT_EQ(at_most("x", 0.0, 0.1).range(), "at most 0.1");
    EXPECT_EQ(at_least("x", 0.0, 3.0).range(), "at least 3");
    EXPECT_EQ(within("x", 0.0, 0.9, 1.1).range(), "0.9 to 1.1");
    EXPECT_TRUE((Outcome{{at_most("x", 0.0, 0.1), at_least("y", 3.0, 3.0)}, {}}.holds()));
    EXPECT_FALSE((Outcome{{at_most("x", 0.0, 0.1), at_least("y", 2.0, 3.0)}, {}}.holds()));
}

TEST(ValidationCase, NamesAreUnique)
{
    std::set<std::string_view> names;
    for (const Case& one : cases()) {
        EXPECT_TRUE(names.insert(one.name).second) << one.name;
        EXPECT_FALSE(one.about.empty());
    }
}

class ValidationStop : public GpuTest {};

TEST_F(ValidationStop, EndsEveryCaseBeforeItsFirstStep)
{
    const std::atomic<bool> stop = true;
    for (const Case& one : cases()) {
        EXPECT_THROW(one.run({.context = context(), .stop = &stop}), Interrupted) << one.name;
    }
}

} // namespace
} // namespace meltpoint::validation
