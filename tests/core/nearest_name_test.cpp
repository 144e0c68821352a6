#include "core/nearest_name.h"

#include <vector>

#include <gtest/gtest.h>

namespace meltpoint {
namespace {

const std::vector<std::string> NAMES = {"viscosity", "velocity", "gravity", "min", "max"};

TEST(NearestName, FindsTypos)
{
    EXPECT_EQ(nearest_name("viscosty", NAMES), "viscosity"); // a letter missing
    EXPECT_EQ(nearest_name("vellocity", NAMES), "velocity"); // one too many
    EXPECT_EQ(nearest_name("grafity", NAMES), "gravity");    // a wrong one
    EXPECT_EQ(nearest_name("graivty", NAMES), "gravity");    // two swapped
    EXPECT_EQ(nearest_name("mni", NAMES), "min");            // a swap is one edit, not two
    EXPECT_EQ(nearest_name("mix", NAMES), "min");            // the first of equals
    EXPECT_EQ(nearest_name("max", NAMES), "max");
}

TEST(NearestName, DoesNotGuessWildly)
{
    EXPECT_EQ(nearest_name("frames", NAMES), std::nullopt);
    EXPECT_EQ(nearest_name("", NAMES), std::nullopt);
    EXPECT_EQ(nearest_name(std::string(1000, 'v'), NAMES), std::nullopt);
    EXPECT_EQ(nearest_name("max", {}), std::nullopt);
}

} // namespace
} // namespace meltpoint
