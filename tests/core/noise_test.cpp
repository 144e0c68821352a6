#include "core/noise.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"

namespace meltpoint {
namespace {

TEST(Noise, IsZeroAtLatticePointsAndSmoothBetween)
{
    for (const glm::dvec3& point : {glm::dvec3(0.0), glm::dvec3(3.0, -2.0, 5.0), glm::dvec3(-7.0, 0.0, 1.0)}) {
        EXPECT_EQ(gradient_noise(point, 1), 0.0);
        // The same from both sides of a cell's face.
        const glm::dvec3 on_face = point + glm::dvec3(0.0, 0.37, 0.61);
        const glm::dvec3 step(1e-7, 0.0, 0.0);
        EXPECT_NEAR(gradient_noise(on_face - step, 1), gradient_noise(on_face + step, 1), 1e-6);
    }
}

TEST(Noise, StaysInItsRangeAndUsesIt)
{
    Random random(3);
    double lowest = 0.0;
    double highest = 0.0;
    double sum = 0.0;
    constexpr int samples = 20'000;
    for (int i = 0; i < samples; ++i) {
        const glm::dvec3 x = 100.0 * (glm::dvec3(random.uniform(), random.uniform(), random.uniform()) - 0.5);
        const double value = fractal_noise(x, 7);
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
        sum += value;
    }
    EXPECT_GE(lowest, -1.0);
    EXPECT_LE(highest, 1.0);
    EXPECT_LT(lowest, -0.4);
    EXPECT_GT(highest, 0.4);
    EXPECT_NEAR(sum / samples, 0.0, 0.02);
}

TEST(Noise, SeedsDiffer)
{
    const glm::dvec3 x(0.3, 0.7, 0.2);
    EXPECT_EQ(fractal_noise(x, 1), fractal_noise(x, 1));
    EXPECT_NE(fractal_noise(x, 1), fractal_noise(x, 2));
    EXPECT_NE(gradient_noise(x, 1), gradient_noise(x + glm::dvec3(1.0, 0.0, 0.0), 1)); // nor do cells repeat
}

TEST(Noise, OctavesAddFinerLumps)
{
    // Four octaves change faster than one: of steps of an eighth of a cell, by more than a third.
    double coarse = 0.0;
    double fine = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 x(0.125 * i, 0.37, 0.71);
        const glm::dvec3 next = x + glm::dvec3(0.125, 0.0, 0.0);
        coarse += std::pow(8.0 / 15.0 * (gradient_noise(next, 4) - gradient_noise(x, 4)), 2.0);
        fine += std::pow(fractal_noise(next, 1) - fractal_noise(x, 1), 2.0);
    }
    EXPECT_GT(std::sqrt(fine), 1.33 * std::sqrt(coarse));
}

} // namespace
} // namespace meltpoint
