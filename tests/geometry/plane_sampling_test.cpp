#include "geometry/plane_sampling.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/error.h"

namespace meltpoint {
namespace {

TEST(PlaneSampling, RectanglesAreFilledExactly)
{
    const VolumeSamples samples = sample_rectangle({-1.0f, 2.0f}, {1.0f, 3.0f}, 0.11);
    EXPECT_EQ(samples.positions.size(), 18u * 9u);
    EXPECT_NEAR(samples.particle_volume * static_cast<double>(samples.positions.size()), 2.0, 1e-9);
    for (const glm::vec3& x : samples.positions) {
        EXPECT_EQ(x.z, 0.0f);
        EXPECT_GT(x.x, -1.0f + 0.05f);
        EXPECT_LT(x.x, 1.0f - 0.05f);
        EXPECT_GT(x.y, 2.0f + 0.05f);
        EXPECT_LT(x.y, 3.0f - 0.05f);
    }
}

TEST(PlaneSampling, DisksHoldTheirArea)
{
    for (const double radius : {0.06, 0.1, 0.333, 1.0}) {
        const VolumeSamples samples = sample_disk({0.5f, -0.25f}, radius, 0.02);
        const double area = std::numbers::pi * radius * radius;
        const auto count = static_cast<double>(samples.positions.size());
        EXPECT_NEAR(count * samples.spacing * samples.spacing / area, 1.0, radius > 0.1 ? 2e-3 : 0.01) << radius;
        EXPECT_NEAR(samples.spacing, 0.02, 0.025 * 0.02 + 1e-12);
        EXPECT_NEAR(samples.particle_volume * count, area, 1e-12);
        for (const glm::vec3& x : samples.positions) {
            EXPECT_LT(glm::distance(glm::vec2(x), glm::vec2(0.5f, -0.25f)), static_cast<float>(radius) + 1e-6f);
            EXPECT_EQ(x.z, 0.0f);
        }
    }
}

TEST(PlaneSampling, OutlinesAreClosedAndEven)
{
    const std::vector<glm::vec3> square = outline_rectangle({0.0f, 0.0f}, {1.0f, 0.5f}, 0.11);
    EXPECT_EQ(square.size(), 2u * (10u + 5u));
    const std::vector<glm::vec3> circle = outline_disk({1.0f, 1.0f}, 0.5, 0.1);
    EXPECT_EQ(circle.size(), 32u);
    for (const std::vector<glm::vec3>& outline : {square, circle}) {
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const float step = glm::distance(outline[i], outline[(i + 1) % outline.size()]);
            EXPECT_LE(step, 0.11f + 1e-6f);
            EXPECT_GE(step, 0.09f);
        }
    }
    EXPECT_EQ(outline_rectangle({0.0f, 0.0f}, {0.0f, 1.0f}, 0.25).size(), 5u); // a line, with both ends
}

TEST(PlaneSampling, RefusesWhatCannotBeFilled)
{
    EXPECT_THROW(static_cast<void>(sample_rectangle({0.0f, 0.0f}, {1.0f, 0.01f}, 0.1)), Error);
    EXPECT_THROW(static_cast<void>(sample_rectangle({0.0f, 0.0f}, {1.0f, 1.0f}, 0.0)), Error);
    EXPECT_THROW(static_cast<void>(sample_rectangle({0.0f, 0.0f}, {1.0f, 1.0f}, 1e-6)), Error);
    EXPECT_THROW(static_cast<void>(sample_disk({0.0f, 0.0f}, 0.01, 0.1)), Error);
}

} // namespace
} // namespace meltpoint
