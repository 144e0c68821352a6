#include "run/dissolve_front.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace meltpoint {
namespace {

std::vector<glm::vec3> column()
{
    std::vector<glm::vec3> points;
    for (int i = 0; i < 50; ++i) {
        points.emplace_back(0.1f * static_cast<float>(i % 5), 1.0f + 0.02f * static_cast<float>(i), 0.3f);
    }
    return points;
}

TEST(DissolveFront, RunsDownwardUnlessToldOtherwise)
{
    const std::vector<glm::vec3> points = column();
    const std::vector<float> times = arrival_times({.speed = 0.5f, .start = 2.0f}, points, 1);
    ASSERT_EQ(times.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_NEAR(times[i], 2.0f + (points.back().y - points[i].y) / 0.5f, 1e-5f);
    }
}

TEST(DissolveFront, RunsAlongADirectionOfAnyLength)
{
    const std::vector<glm::vec3> points = column();
    const std::vector<float> times =
        arrival_times({.speed = 2.0f, .direction = glm::vec3(3.0f, 0.0f, 0.0f)}, points, 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_NEAR(times[i], points[i].x / 2.0f, 1e-6f);
    }
}

TEST(DissolveFront, SpreadsFromAPoint)
{
    const std::vector<glm::vec3> points = column();
    const glm::vec3 source(0.0f, 3.0f, 0.3f);
    const std::vector<float> times = arrival_times({.speed = 1.0f, .point = source}, points, 1);
    float nearest = 1e9f;
    for (const glm::vec3& x : points) {
        nearest = std::min(nearest, glm::distance(x, source));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_NEAR(times[i], glm::distance(points[i], source) - nearest, 1e-5f);
    }
}

TEST(DissolveFront, NoiseMovesItByNoMoreThanItsRoughness)
{
    const std::vector<glm::vec3> points = column();
    const DissolveFront smooth{.speed = 0.5f, .start = 1.0f};
    DissolveFront rough = smooth;
    rough.roughness = 0.2f;
    const std::vector<float> even = arrival_times(smooth, points, 1);
    const std::vector<float> uneven = arrival_times(rough, points, 1);
    float farthest = 0.0f;
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_GE(uneven[i], 1.0f); // never before it starts
        farthest = std::max(farthest, std::abs(uneven[i] - even[i]));
    }
    EXPECT_LE(farthest, 0.2f / 0.5f + 1e-5f);
    EXPECT_GT(farthest, 0.02f / 0.5f);
    EXPECT_EQ(uneven, arrival_times(rough, points, 1));
    EXPECT_NE(uneven, arrival_times(rough, points, 2));
}

} // namespace
} // namespace meltpoint
