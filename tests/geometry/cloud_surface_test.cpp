#include "geometry/cloud_surface.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/error.h"
#include "support/clouds.h"

namespace meltpoint {
namespace {

constexpr double pi = std::numbers::pi;
using test::fibonacci_sphere;
using test::points_on;
using test::torus_normal;

/// Mean angle between the normals of a surface and the true ones, in degrees, all on the true side.
template <class Truth>
double mean_error(const CloudSurface& surface, const Truth& truth)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < surface.cloud.size(); ++i) {
        const glm::vec3 normal = surface.cloud.normals[i];
        EXPECT_NEAR(glm::length(normal), 1.0f, 1e-5f);
        const float cosine = glm::dot(normal, truth(surface.cloud.positions[i]));
        EXPECT_GT(cosine, 0.0f) << "point " << i << " looks inward";
        sum += std::acos(std::min(double(cosine), 1.0)) * 180.0 / pi;
    }
    return sum / double(surface.cloud.size());
}

glm::vec3 sphere_normal(const glm::vec3& point)
{
    return glm::normalize(point);
}

glm::vec3 cube_normal(const glm::vec3& point)
{
    const glm::vec3 size = glm::abs(point);
    const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    glm::vec3 normal(0.0f);
    normal[axis] = point[axis] > 0.0f ? 1.0f : -1.0f;
    return normal;
}

std::string refusal(const PointCloud& cloud)
{
    try {
        (void)make_cloud_surface(cloud, "scan.xyz");
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        EXPECT_TRUE(std::string(error.what()).starts_with("scan.xyz: ")) << error.what();
        return error.what();
    }
    return "";
}

TEST(CloudSurface, NormalsOfSmoothShapesAreFoundAndLookOutward)
{
    const CloudSurface even = make_cloud_surface(fibonacci_sphere(2000), "sphere");
    EXPECT_LT(mean_error(even, sphere_normal), 0.5);
    EXPECT_EQ(even.facts.estimated, 2000u);
    EXPECT_EQ(even.facts.pieces, 1u);
    EXPECT_EQ(even.facts.unknown, 0u);
    EXPECT_LT(mean_error(make_cloud_surface(points_on("sphere", 4000, SurfaceMethod::Random), "sphere"), sphere_normal),
              1.5);
    EXPECT_LT(mean_error(make_cloud_surface(points_on("torus", 6000, SurfaceMethod::Random), "torus"), torus_normal),
              3.0);
    EXPECT_LT(mean_error(make_cloud_surface(points_on("torus", 6000, SurfaceMethod::BlueNoise), "torus"), torus_normal),
              1.0);
}

TEST(CloudSurface, NormalsLookOutwardAcrossSharpEdges)
{
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const CloudSurface surface = make_cloud_surface(points_on("cube", 5000, SurfaceMethod::Random, seed), "cube");
        EXPECT_EQ(surface.facts.pieces, 1u);
        EXPECT_LT(mean_error(surface, cube_normal), 10.0);
    }
}

/// A wedge, 2 m long in x, with edges of 60 degrees, closed.
TriangleMesh wedge()
{
    TriangleMesh mesh;
    for (const float x : {-1.0f, 1.0f}) {
        mesh.positions.insert(mesh.positions.end(), {{x, 0.0f, -0.577f}, {x, 0.0f, 0.577f}, {x, 1.0f, 0.0f}});
    }
    mesh.triangles = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4}, {0, 4, 1}, {1, 4, 5}, {1, 5, 2}, {2, 5, 3}, {2, 3, 0}};
    return mesh;
}

TEST(CloudSurface, NormalsLookOutwardAcrossEdgesOfSixtyDegrees)
{
    ASSERT_GT(signed_volume(wedge()), 1.1);
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
        const PointCloud truth = sample_surface(wedge(), {SurfaceMethod::Random, PointCount{3000}, seed}).cloud;
        PointCloud cloud;
        cloud.positions = truth.positions;
        const CloudSurface surface = make_cloud_surface(cloud, "wedge");
        std::size_t inward = 0;
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            inward += glm::dot(surface.cloud.normals[i], truth.normals[i]) < 0.0f ? 1 : 0;
        }
        EXPECT_LT(inward, 30u) << "seed " << seed; // on the edge itself
    }
}

TEST(CloudSurface, NoiseIsNoObstacle)
{
    PointCloud cloud = points_on("torus", 6000, SurfaceMethod::Random);
    test::shake(cloud, 0.02); // points are 0.05 apart
    EXPECT_LT(mean_error(make_cloud_surface(cloud, "torus"), torus_normal), 20.0);
}

TEST(CloudSurface, EveryPieceLooksOutwardByItself)
{
    PointCloud cloud;
    for (int piece = 0; piece < 3; ++piece) {
        for (const glm::vec3& position : fibonacci_sphere(700).positions) {
            cloud.positions.push_back(position + glm::vec3(3.0f * float(piece), 0.0f, 0.0f));
        }
    }
    const CloudSurface surface = make_cloud_surface(cloud, "three spheres");
    EXPECT_EQ(surface.facts.pieces, 3u);
    const auto normal = [](const glm::vec3& point) {
        return glm::normalize(point - glm::vec3(3.0f * std::round(point.x / 3.0f), 0.0f, 0.0f));
    };
    EXPECT_LT(mean_error(surface, normal), 1.0);
}

TEST(CloudSurface, AStrayPointTurnsNothing)
{
    PointCloud cloud = fibonacci_sphere(2000);
    cloud.positions.emplace_back(0.3f, 1.5f, 0.2f);
    cloud.positions.emplace_back(-2.0f, 0.1f, 0.2f);
    CloudSurface surface = make_cloud_surface(cloud, "sphere");
    surface.cloud.positions.resize(2000);
    surface.cloud.normals.resize(2000);
    EXPECT_LT(mean_error(surface, sphere_normal), 1.0);
    EXPECT_NEAR(surface.area, 4.0 * pi, 0.03 * 4.0 * pi) << "and stands for no more than others";
}

TEST(CloudSurface, GivenNormalsStayAndOthersFollowThem)
{
    for (const float side : {1.0f, -1.0f}) {
        PointCloud cloud = fibonacci_sphere(2000);
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            // Tilted, so that an estimate would not be the same.
            const glm::vec3 tilted = glm::normalize(cloud.positions[i] + glm::vec3(0.1f, 0.0f, 0.0f));
            cloud.normals.push_back(i % 50 == 0 ? side * tilted : glm::vec3(0.0f));
        }
        const CloudSurface surface = make_cloud_surface(cloud, "sphere");
        EXPECT_EQ(surface.facts.estimated, 1960u);
        EXPECT_EQ(surface.facts.pieces, 0u);
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            if (i % 50 == 0) {
                ASSERT_EQ(surface.cloud.normals[i], cloud.normals[i]);
            } else {
                ASSERT_GT(side * glm::dot(surface.cloud.normals[i], cloud.positions[i]), 0.99f);
            }
        }
    }
}

TEST(CloudSurface, RowsOfAScannerAreOneSurface)
{
    PointCloud cloud; // 12 rows a radian, 120 points a radian
    for (int row = -14; row <= 14; ++row) {
        const double latitude = row / 12.0;
        const int points = int(2.0 * pi * 120.0 * std::cos(latitude));
        for (int i = 0; i < points; ++i) {
            const double angle = 2.0 * pi * i / points;
            cloud.positions.emplace_back(std::cos(latitude) * std::cos(angle), std::sin(latitude),
                                         std::cos(latitude) * std::sin(angle));
        }
    }
    const CloudSurface surface = make_cloud_surface(cloud, "rows");
    EXPECT_EQ(surface.facts.pieces, 1u);
    EXPECT_LT(mean_error(surface, sphere_normal), 3.0);
    const double covered = 4.0 * pi * std::sin(14.5 / 12.0);
    EXPECT_NEAR(surface.area, covered, 0.03 * covered);
}

TEST(CloudSurface, CellsHaveTheAreaOfTheSurface)
{
    for (const std::uint64_t seed : {1u, 2u}) {
        const double torus = 4.0 * pi * pi * 0.4;
        for (const SurfaceMethod method : {SurfaceMethod::Random, SurfaceMethod::BlueNoise}) {
            EXPECT_NEAR(make_cloud_surface(points_on("torus", 6000, method, seed), "torus").area, torus, 0.01 * torus);
            EXPECT_NEAR(make_cloud_surface(points_on("cube", 6000, method, seed), "cube").area, 6.0, 0.04 * 6.0)
                << "edges come out round";
        }
    }
    const double hemisphere = 2.0 * pi; // open: with a rim
    EXPECT_NEAR(make_cloud_surface(fibonacci_sphere(4000, 0.0f), "bowl").area, hemisphere, 0.02 * hemisphere);
}

TEST(CloudSurface, CellsAreSmallWherePointsAreDense)
{
    PointCloud cloud = fibonacci_sphere(1000);
    for (const glm::vec3& position : fibonacci_sphere(16'000).positions) {
        if (position.x > 0.0f) {
            cloud.positions.push_back(position);
        }
    }
    const CloudSurface surface = make_cloud_surface(cloud, "sphere");
    double dense = 0.0;
    for (std::size_t i = 0; i < surface.cloud.size(); ++i) {
        dense += surface.cloud.positions[i].x > 0.0f ? surface.cells.areas()[i] : 0.0;
    }
    EXPECT_NEAR(surface.area, 4.0 * pi, 0.02 * 4.0 * pi);
    EXPECT_NEAR(dense, 2.0 * pi, 0.04 * 2.0 * pi);
}

TEST(CloudSurface, APlaneLooksUpAndEndsHalfASpacingBeyondItsPoints)
{
    PointCloud cloud;
    for (int x = 0; x < 30; ++x) {
        for (int z = 0; z < 20; ++z) {
            cloud.positions.emplace_back(0.1f * float(x), 5.0f, 0.1f * float(z));
        }
    }
    const CloudSurface surface = make_cloud_surface(cloud, "floor");
    EXPECT_NEAR(surface.area, 30.0 * 20.0 * 0.01, 0.02 * 6.0);
    for (const glm::vec3& normal : surface.cloud.normals) {
        ASSERT_GT(normal.y, 0.9999f);
    }
}

TEST(CloudSurface, PointsInOnePlaceAreOne)
{
    const CloudSurface once = make_cloud_surface(fibonacci_sphere(1000), "sphere");
    PointCloud cloud;
    for (int copy = 0; copy < 30; ++copy) {
        for (const glm::vec3& position : fibonacci_sphere(1000).positions) {
            cloud.positions.push_back(position);
            cloud.normals.push_back(copy == 7 && position.x > 0.9f ? glm::normalize(position) : glm::vec3(0.0f));
            cloud.colors.emplace_back(copy, 0, 0);
        }
    }
    const CloudSurface surface = make_cloud_surface(cloud, "sphere");
    EXPECT_EQ(surface.facts.points, 1000u);
    EXPECT_EQ(surface.facts.duplicates, 29'000u);
    EXPECT_GT(surface.facts.estimated, 900u);
    EXPECT_LT(surface.facts.estimated, 1000u);
    EXPECT_EQ(surface.cloud.positions, once.cloud.positions) << "and in the same order";
    EXPECT_EQ(surface.cloud.colors.at(999), glm::u8vec3(0, 0, 0));
    EXPECT_NEAR(surface.area, once.area, 1e-3 * once.area);
}

TEST(CloudSurface, PointsOnALineHaveNoNormal)
{
    PointCloud cloud = fibonacci_sphere(1000);
    for (int i = 0; i < 400; ++i) { // a mast
        cloud.positions.emplace_back(0.0f, 1.2f + 0.02f * float(i), 0.0f);
    }
    const CloudSurface surface = make_cloud_surface(cloud, "sphere with a mast");
    EXPECT_GT(surface.facts.unknown, 250u);
    EXPECT_LE(surface.facts.unknown, 400u);
    EXPECT_EQ(surface.facts.unknown + surface.facts.estimated, 1400u);
    std::size_t unknown = 0;
    for (std::size_t i = 0; i < surface.cloud.size(); ++i) {
        if (surface.cloud.normals[i] == glm::vec3(0.0f)) {
            ++unknown;
            ASSERT_EQ(surface.cells.areas()[i], 0.0);
        } else if (i < 950) {
            ASSERT_GT(glm::dot(surface.cloud.normals[i], surface.cloud.positions[i]), 0.0f);
        }
    }
    EXPECT_EQ(unknown, surface.facts.unknown);
}

TEST(CloudSurface, WhatIsNoSurfaceIsRefused)
{
    PointCloud cloud;
    EXPECT_NE(refusal(cloud).find("the cloud has 0"), std::string::npos);
    cloud.positions = {{1, 2, 3}};
    EXPECT_NE(refusal(cloud).find("the cloud has 1"), std::string::npos);
    cloud.positions = {{1, 2, 3}, {2, 2, 3}, {1, 2, 3}, {2, 2, 3}};
    EXPECT_NE(refusal(cloud).find("the cloud has 2"), std::string::npos);
    cloud.positions = {{0, 0, 0}, {1e-10f, 0, 0}, {0, 1e-10f, 0}};
    EXPECT_NE(refusal(cloud).find("1e-10 m across"), std::string::npos);
    for (const glm::vec3 way : {glm::vec3(1, 0, 0), glm::vec3(0.3f, 1.7f, -0.9f)}) {
        cloud.positions.clear();
        for (int i = 0; i < 500; ++i) {
            cloud.positions.push_back(float(i * i) * way);
        }
        EXPECT_NE(refusal(cloud).find("on a line"), std::string::npos);
    }
    cloud.positions.assign(10'000'001, glm::vec3(0.0f));
    EXPECT_NE(refusal(cloud).find("at most 10000000"), std::string::npos);
}

TEST(CloudSurface, FewPointsAreASurfaceToo)
{
    PointCloud cloud;
    cloud.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    const CloudSurface triangle = make_cloud_surface(cloud, "triangle");
    EXPECT_GT(triangle.area, 0.1);
    EXPECT_LT(triangle.area, 10.0);
    for (const glm::vec3& normal : triangle.cloud.normals) {
        EXPECT_NEAR(normal.y, 1.0f, 1e-5f);
    }
}

TEST(CloudSurface, AnySizeAndAnyPlace)
{
    for (const float scale : {1e-8f, 1.0f, 1e8f}) {
        PointCloud cloud = fibonacci_sphere(2000);
        for (glm::vec3& position : cloud.positions) {
            position *= scale;
        }
        const CloudSurface surface = make_cloud_surface(cloud, "sphere");
        EXPECT_LT(mean_error(surface, sphere_normal), 0.5) << scale;
        EXPECT_NEAR(surface.area / (double(scale) * double(scale)), 4.0 * pi, 0.01 * 4.0 * pi) << scale;
    }
    PointCloud far = fibonacci_sphere(2000);
    for (glm::vec3& position : far.positions) {
        position += glm::vec3(3000.0f, 0.0f, -4000.0f);
    }
    const auto normal = [](const glm::vec3& point) {
        return glm::normalize(point - glm::vec3(3000.0f, 0.0f, -4000.0f));
    };
    EXPECT_LT(mean_error(make_cloud_surface(far, "far"), normal), 1.0);
    // So far away that floats are as far apart as points: nothing sensible, but no harm.
    for (glm::vec3& position : far.positions) {
        position += glm::vec3(1e6f, 1e6f, 0.0f);
    }
    EXPECT_GT(make_cloud_surface(far, "far").area, 0.0);
}

TEST(CloudSurface, IsTheSameOnAnyNumberOfThreads)
{
    PointCloud cloud = points_on("torus", 6000, SurfaceMethod::Random);
    test::shake(cloud, 0.02);
    const auto run = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return make_cloud_surface(cloud, "torus");
    };
    const CloudSurface one = run(1);
    for (const std::size_t threads : {2u, 7u}) {
        const CloudSurface other = run(threads);
        ASSERT_EQ(other.cloud.size(), one.cloud.size());
        EXPECT_EQ(
            std::memcmp(one.cloud.normals.data(), other.cloud.normals.data(), one.cloud.size() * sizeof(glm::vec3)), 0);
        EXPECT_EQ(one.cells.areas(), other.cells.areas());
        EXPECT_EQ(one.area, other.area);
    }
}

} // namespace
} // namespace meltpoint
