#include "core/color.h"

#include <limits>

#include <gtest/gtest.h>

namespace meltpoint {
namespace {

TEST(Color, SrgbGoesToLightAndBack)
{
    EXPECT_EQ(linear_from_srgb(0.0), 0.0);
    EXPECT_EQ(linear_from_srgb(1.0), 1.0);
    EXPECT_NEAR(linear_from_srgb(0.5), 0.21404, 1e-5);        // IEC 61966-2-1
    EXPECT_NEAR(linear_from_srgb(0.02), 0.02 / 12.92, 1e-12); // the straight part
    for (int i = 0; i <= 255; ++i) {
        EXPECT_EQ(color_byte(255.0 * srgb_from_linear(linear_from_srgb(i / 255.0))), i);
    }
}

TEST(Color, BytesAreRoundedAndKeptInRange)
{
    EXPECT_EQ(color_byte(127.4), 127);
    EXPECT_EQ(color_byte(127.5), 128);
    EXPECT_EQ(color_byte(-1e30), 0);
    EXPECT_EQ(color_byte(1e30), 255);
    EXPECT_EQ(color_byte(std::numeric_limits<double>::infinity()), 255);
    EXPECT_EQ(color_byte(std::numeric_limits<double>::quiet_NaN()), 0);
}

} // namespace
} // namespace meltpoint
