#include "core/random.h"

#include <gtest/gtest.h>

namespace meltpoint {
namespace {

TEST(Random, SameSeedAndStreamGiveTheSameNumbers)
{
    Random a(7, 3);
    Random b(7, 3);
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(a.next(), b.next());
    }
}

TEST(Random, StreamsAndSeedsDiffer)
{
    EXPECT_NE(Random(7, 0).next(), Random(7, 1).next());
    EXPECT_NE(Random(7, 0).next(), Random(8, 0).next());
}

TEST(Random, UniformHasTheMomentsOfTheUniformDistribution)
{
    Random random(1);
    const int count = 1'000'000;
    double sum = 0.0;
    double sum_of_squares = 0.0;
    for (int i = 0; i < count; ++i) {
        const double u = random.uniform();
        ASSERT_GE(u, 0.0);
        ASSERT_LT(u, 1.0);
        sum += u;
        sum_of_squares += u * u;
    }
    // Standard errors at this count are 2.9e-4 and 3.0e-4: five of them.
    EXPECT_NEAR(sum / count, 0.5, 1.5e-3);
    EXPECT_NEAR(sum_of_squares / count, 1.0 / 3.0, 1.5e-3);
}

TEST(Random, BelowStaysBelow)
{
    Random random(2);
    int seen[5] = {};
    for (int i = 0; i < 5000; ++i) {
        const std::uint32_t value = random.below(5);
        ASSERT_LT(value, 5u);
        ++seen[value];
    }
    for (const int count : seen) {
        EXPECT_GT(count, 800);
    }
}

} // namespace
} // namespace meltpoint
