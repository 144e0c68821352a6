// Sums in two floats, as C++ has them; as the device has them: sim/heat_test.cpp.
#include "shared/two_float.h"

#include <gtest/gtest.h>

namespace meltpoint {
namespace {

TEST(TwoFloat, AMillionSmallTermsAreAllThere)
{
    const float start = 334e3f;
    const float term = 1e-3f;
    glm::vec2 sum(start, 0.0f);
    float alone = start;
    constexpr int terms = 1'000'000;
    for (int i = 0; i < terms; ++i) {
        sum = shared::two_float_add(sum, term);
        alone += term;
    }
    const double exact = static_cast<double>(start) + terms * static_cast<double>(term);
    EXPECT_NEAR(static_cast<double>(sum.x) + static_cast<double>(sum.y), exact, 1e-4);
    EXPECT_EQ(alone, start); // a float would have lost them one and all
    for (int i = 0; i < terms; ++i) {
        sum = shared::two_float_add(sum, -term);
    }
    EXPECT_NEAR(static_cast<double>(sum.x) + static_cast<double>(sum.y), static_cast<double>(start), 1e-4);
    const glm::vec2 swapped = shared::two_float_add({1e-3f, 0.0f}, 334e3f); // the larger one last
    EXPECT_EQ(static_cast<double>(swapped.x) + static_cast<double>(swapped.y), 334e3 + static_cast<double>(1e-3f));
}

} // namespace
} // namespace meltpoint
