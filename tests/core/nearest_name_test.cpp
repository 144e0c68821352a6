#include "core/nearest_name.h"

#include <vector>

#include <gtest/gtest.h>

namespace meltpoint {
namespace {

const std::vector<std::string> names = {"viscosity", "velocity", "gravity", "min", "max"};

TEST(NearestName, FindsTypos)
{
    EXPECT_EQ(nearest_name("viscosty", names), "viscosity"); // a letter missing
    EXPECT_EQ(nearest_name("vellocity", names), "velocity"); // one too many
    EXPECT_EQ(nearest_name("grafity", names), "gravity");    // a wrong one
    EXPECT_EQ(nearest_name("graivty", names), "gravity");    // two swapped
    EXPECT_EQ(nearest_name("mni", names), "min");            // a swap is one edit, not two
    EXPECT_EQ(nearest_name("mix", names), "min");            // the first of equals
    EXPECT_EQ(nearest_name("max", names), "max");
}

TEST(NearestName, DoesNotGuessWildly)
{
    EXPECT_EQ(nearest_name("frames", names), std::nullopt);
    EXPECT_EQ(nearest_name("", names), std::nullopt);
    EXPECT_EQ(nearest_name(std::string(1000, 'v'), names), std::nullopt);
    EXPECT_EQ(nearest_name("max", {}), std::nullopt);
}

} // namespace
} // namespace meltpoint
