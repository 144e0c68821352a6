#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/error.h"
#include "geometry/cloud_surface.h"
#include "geometry/point_cells.h"
#include "geometry/surface_sampling.h"
#include "support/clouds.h"

namespace meltpoint {
namespace {

constexpr double pi = std::numbers::pi;
using test::fibonacci_sphere;

/// A sphere, four times as dense where x > 0, red there and blue elsewhere.
CloudSurface uneven_sphere()
{
    PointCloud cloud;
    for (const glm::vec3& position : fibonacci_sphere(2000).positions) {
        if (position.x <= 0.0f) {
            cloud.positions.push_back(position);
            cloud.colors.emplace_back(0, 0, 255);
        }
    }
    for (const glm::vec3& position : fibonacci_sphere(8000).positions) {
        if (position.x > 0.0f) {
            cloud.positions.push_back(position);
            cloud.colors.emplace_back(255, 0, 0);
        }
    }
    return make_cloud_surface(cloud, "sphere");
}

TEST(CloudSampling, PointsAreUniformOnTheSurfaceWhateverTheDensityOfTheCloud)
{
    const CloudSurface surface = uneven_sphere();
    constexpr int bands = 20; // of equal area, across the border of the densities and along it
    for (const SurfaceMethod method : {SurfaceMethod::Random, SurfaceMethod::Stratified, SurfaceMethod::BlueNoise}) {
        for (const std::size_t count : {1000u, 20'000u}) { // fewer and more than the cloud has
            const PointCloud cloud = sample_surface(surface, {method, PointCount{count}, 5}).cloud;
            ASSERT_EQ(cloud.size(), count);
            for (int axis = 0; axis < 2; ++axis) {
                std::vector<double> counts(bands);
                for (const glm::vec3& position : cloud.positions) {
                    const double place = 0.5 * (double(position[axis]) + 1.0) * bands;
                    counts[std::size_t(std::clamp(place, 0.0, bands - 0.5))] += 1.0;
                }
                const double expected = double(count) / bands;
                double statistic = 0.0;
                for (const double each : counts) {
                    statistic += (each - expected) * (each - expected) / expected;
                }
                EXPECT_LT(statistic, 60.0) << int(method) << " " << count << " " << axis; // p = 1e-6 at 19 degrees
                EXPECT_TRUE(method != SurfaceMethod::BlueNoise || statistic < 19.0);
            }
        }
    }
}

TEST(CloudSampling, PointsLieOnTheSurfaceAndCarryNormalAndColor)
{
    const CloudSurface surface = uneven_sphere();
    const SurfaceSamples samples = sample_surface(surface, {SurfaceMethod::Random, PointCount{20'000}});
    EXPECT_NEAR(samples.area, 4.0 * pi, 0.02 * 4.0 * pi);
    EXPECT_DOUBLE_EQ(samples.spacing, std::sqrt(samples.area / 20'000.0));
    EXPECT_TRUE(samples.cloud.triangle.empty());
    EXPECT_TRUE(samples.cloud.barycentric.empty());
    ASSERT_EQ(samples.cloud.normals.size(), 20'000u);
    ASSERT_EQ(samples.cloud.colors.size(), 20'000u);
    double off = 0.0;
    for (std::size_t i = 0; i < samples.cloud.size(); ++i) {
        const glm::vec3& p = samples.cloud.positions[i];
        off = std::max(off, std::abs(double(glm::length(p)) - 1.0));
        ASSERT_GT(glm::dot(samples.cloud.normals[i], glm::normalize(p)), 0.98f);
        const glm::u8vec3 red_or_blue = p.x > 0.0f ? glm::u8vec3(255, 0, 0) : glm::u8vec3(0, 0, 255);
        ASSERT_TRUE(std::abs(p.x) < 0.1f || samples.cloud.colors[i] == red_or_blue);
    }
    EXPECT_LT(off, 0.02);
    EXPECT_GT(off, 1e-4) << "they are new points, not the cloud's own";
}

TEST(CloudSampling, PointsFillTheirCells)
{
    PointCloud grid; // with square cells
    for (int x = 0; x < 20; ++x) {
        for (int z = 0; z < 20; ++z) {
            grid.positions.emplace_back(x, 0, z);
        }
    }
    const SurfaceSamples samples = sample_surface(make_cloud_surface(grid, "grid"), {.amount = PointCount{40'000}});
    std::array<double, 16> counts{}; // of sixteenths of a cell
    for (const glm::vec3& p : samples.cloud.positions) {
        ASSERT_NEAR(p.y, 0.0f, 1e-6f);
        const glm::vec2 place = glm::fract(glm::vec2(p.x, p.z) + 0.5f) * 4.0f;
        counts[std::size_t(place.x) + 4 * std::size_t(place.y)] += 1.0;
    }
    for (const double count : counts) {
        EXPECT_NEAR(count, 2500.0, 250.0); // five standard deviations
    }
}

TEST(CloudSampling, BlueNoiseKeepsItsDistance)
{
    const SurfaceSamples samples = sample_surface(uneven_sphere(), {SurfaceMethod::BlueNoise, PointCount{3000}});
    const std::vector<glm::vec3>& points = samples.cloud.positions;
    const double densest = 2.0 * std::sqrt(samples.area / (2.0 * std::sqrt(3.0) * double(points.size())));
    const PointCells cells(points, densest);
    double nearest = densest;
    for (std::size_t place = 0; place < points.size(); ++place) {
        cells.visit_near(place, [&](std::uint32_t other) {
            if (other != place) {
                nearest = std::min(nearest,
                                   double(glm::distance(points[cells.order()[place]], points[cells.order()[other]])));
            }
        });
    }
    EXPECT_GE(nearest / densest, 0.69);
}

TEST(CloudSampling, ASpacingGivesEachPointItsSquare)
{
    const CloudSurface surface = uneven_sphere();
    const SurfaceSamples samples = sample_surface(surface, {SurfaceMethod::Stratified, PointSpacing{0.05}});
    EXPECT_EQ(samples.cloud.size(), std::size_t(std::round(surface.area / 0.0025)));
    EXPECT_THROW((void)sample_surface(surface, {SurfaceMethod::Random, PointSpacing{0.0}}), Error);
    EXPECT_THROW((void)sample_surface(surface, {SurfaceMethod::Random, PointCount{std::size_t{1} << 40}}), Error);
}

TEST(CloudSampling, IsTheSameOnAnyNumberOfThreads)
{
    for (const SurfaceMethod method : {SurfaceMethod::Random, SurfaceMethod::Stratified, SurfaceMethod::BlueNoise}) {
        const auto run = [&](std::size_t threads, std::uint64_t seed) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            return sample_surface(uneven_sphere(), {method, PointCount{2000}, seed}).cloud;
        };
        const PointCloud one = run(1, 7);
        const PointCloud other = run(7, 7);
        ASSERT_EQ(other.size(), one.size());
        EXPECT_EQ(std::memcmp(one.positions.data(), other.positions.data(), one.size() * sizeof(glm::vec3)), 0);
        EXPECT_EQ(std::memcmp(one.normals.data(), other.normals.data(), one.size() * sizeof(glm::vec3)), 0);
        EXPECT_NE(run(1, 8).positions[0], one.positions[0]);
    }
}

} // namespace
} // namespace meltpoint
