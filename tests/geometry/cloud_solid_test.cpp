#include "geometry/cloud_solid.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/error.h"
#include "geometry/mesh_solid.h"
#include "geometry/volume_sampling.h"
#include "support/clouds.h"

namespace meltpoint {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double ball = 4.0 / 3.0 * pi;
constexpr double torus = 2.0 * pi * pi * 0.16;
using test::fibonacci_sphere;
using test::points_on;

CloudSolid solid_of(PointCloud cloud)
{
    return CloudSolid(make_cloud_surface(std::move(cloud), "cloud"));
}

TEST(CloudSolid, HasTheVolumeOfTheShape)
{
    EXPECT_NEAR(solid_of(fibonacci_sphere(3000)).volume(), ball, 0.01 * ball);
    EXPECT_NEAR(solid_of(points_on("sphere", 4000, SurfaceMethod::Random)).volume(), ball, 0.02 * ball);
    EXPECT_NEAR(solid_of(points_on("torus", 6000, SurfaceMethod::Random)).volume(), torus, 0.02 * torus);
    EXPECT_NEAR(solid_of(points_on("cube", 6000, SurfaceMethod::BlueNoise)).volume(), 1.0, 0.02);
}

TEST(CloudSolid, WhatLiesFlatOrFacesInwardHasNoVolume)
{
    PointCloud inward = fibonacci_sphere(3000);
    for (const glm::vec3& position : inward.positions) {
        inward.normals.push_back(-position);
    }
    Random random(5);
    PointCloud tilted;
    PointCloud rough;
    for (int i = 0; i < 3000; ++i) {
        const auto x = static_cast<float>(random.uniform());
        const auto y = static_cast<float>(random.uniform());
        tilted.positions.emplace_back(x, y, 0.5f * x + 0.3f * y);
        rough.positions.emplace_back(x, y, 0.01f * static_cast<float>(random.uniform()));
    }
    for (const PointCloud& cloud : {inward, tilted, rough}) {
        const CloudSolid solid = solid_of(cloud);
        EXPECT_EQ(solid.volume(), 0.0);
        EXPECT_THROW(static_cast<void>(sample_volume(solid, {.amount = PointCount{1000}})), Error);
    }
}

TEST(CloudSolid, IsFilledToItsVolume)
{
    const CloudSolid solid = solid_of(points_on("torus", 8000, SurfaceMethod::Random));
    for (const Lattice lattice : {Lattice::Cubic, Lattice::Fcc, Lattice::BlueNoise}) {
        const VolumeSamples samples = sample_volume(solid, {lattice, PointCount{2000}});
        EXPECT_NEAR(double(samples.positions.size()), 2000.0, 40.0);
        EXPECT_NEAR(double(samples.positions.size()) * std::pow(samples.spacing, 3), torus, 0.02 * torus);
        for (const glm::vec3& p : samples.positions) {
            ASSERT_LT(std::hypot(std::hypot(p.x, p.z) - 1.0f, p.y), 0.4f + 0.02f);
        }
    }
}

/// The built-in sphere without its cap above a height.
TriangleMesh open_sphere(float below)
{
    TriangleMesh mesh = builtin_mesh("sphere");
    std::erase_if(mesh.triangles, [&](const glm::uvec3& t) {
        return (mesh.positions[t.x].y + mesh.positions[t.y].y + mesh.positions[t.z].y) / 3.0f > below;
    });
    return mesh;
}

TEST(CloudSolid, AScanWithAHoleFillsAsAMeshDoes)
{
    constexpr float below = 0.6f; // a fifth of the surface is missing
    const MeshSolid mesh(open_sphere(below));
    for (const std::size_t count : {2000u, 5000u}) {
        const CloudSolid solid = solid_of(fibonacci_sphere(count, below));
        EXPECT_NEAR(solid.volume(), mesh.volume(), 0.02 * mesh.volume()) << count;
        // Nothing comes out of the hole: neither far, nor further than from the mesh.
        const VolumeSamples samples = sample_volume(solid, {.amount = PointSpacing{0.12}});
        for (const glm::vec3& p : samples.positions) {
            ASSERT_LT(glm::length(p), 1.02f);
            ASSERT_TRUE(p.y < below - 0.1f || mesh.contains(glm::dvec3(p) - glm::dvec3(0.0, 0.06, 0.0)))
                << p.x << " " << p.y << " " << p.z;
        }
        EXPECT_FALSE(solid.contains({0.0, 0.9, 0.0}));
        EXPECT_FALSE(solid.contains({0.0, 3.0, 0.0}));
        EXPECT_TRUE(solid.contains({0.0, 0.3, 0.0}));
    }
}

TEST(CloudSolid, AnUnevenCloudFillsAsAnEvenOne)
{
    PointCloud cloud = fibonacci_sphere(1000); // 16 times as dense on one side
    for (const glm::vec3& position : fibonacci_sphere(15'000).positions) {
        if (position.x > 0.0f) {
            cloud.positions.push_back(position);
        }
    }
    const CloudSolid solid = solid_of(cloud);
    EXPECT_NEAR(solid.volume(), ball, 0.02 * ball);
    for (const double x : {-0.8, -0.4, 0.0, 0.4, 0.8}) {
        EXPECT_NEAR(solid.winding().at({x, 0.0, 0.0}), 1.0, 0.04) << x;
    }
}

TEST(CloudSolid, FromAfarTheWindingNumberIsThatOfTheMesh)
{
    const TriangleMesh mesh = open_sphere(0.6f);
    const CloudSurface surface = make_cloud_surface(fibonacci_sphere(5000, 0.6f), "cloud");
    const CloudSolid solid(surface);
    Random random(3);
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 point(3.0 * random.uniform() - 1.5, 3.0 * random.uniform() - 1.5,
                               3.0 * random.uniform() - 1.5);
        if (std::abs(glm::length(point) - 1.0) > 0.1) {
            ASSERT_NEAR(solid.winding().at(point), winding_number_exact(mesh, point), 0.02);
        }
    }
}

TEST(CloudSolid, TheMaskAgreesWithEveryPoint)
{
    const CloudSolid solid = solid_of(fibonacci_sphere(1000));
    CellGrid grid; // fine enough for whole blocks of cells on either side of the surface
    grid.count = {44, 44, 44};
    grid.origin = glm::dvec3(-1.1);
    grid.cell_size = glm::dvec3(0.05);
    grid.points = {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}};
    const CellMask mask = solid.mask(grid);
    std::size_t inside = 0;
    glm::uvec3 cell(0);
    for (cell.z = 0; cell.z < grid.count.z; ++cell.z) {
        for (cell.y = 0; cell.y < grid.count.y; ++cell.y) {
            for (cell.x = 0; cell.x < grid.count.x; ++cell.x) {
                for (std::size_t number = 0; number < 2; ++number) {
                    const bool set = (mask[grid.index(cell)] >> number & 1) != 0;
                    ASSERT_EQ(set, solid.contains(grid.point(cell, number)));
                    inside += set ? 1 : 0;
                }
            }
        }
    }
    EXPECT_NEAR(double(inside), 2.0 * ball / std::pow(0.05, 3), 1000.0);
}

TEST(CloudSolid, WhatEnclosesNothingHasNoVolume)
{
    PointCloud floor;
    for (int x = 0; x < 30; ++x) {
        for (int z = 0; z < 30; ++z) {
            floor.positions.emplace_back(0.1f * float(x), 0.0f, 0.1f * float(z));
        }
    }
    EXPECT_EQ(solid_of(floor).volume(), 0.0);
    PointCloud inverted = fibonacci_sphere(1000);
    for (const glm::vec3& position : inverted.positions) {
        inverted.normals.push_back(-position);
    }
    const CloudSolid solid = solid_of(inverted);
    EXPECT_NEAR(solid.winding().at({0.1, 0.2, 0.3}), -1.0, 0.02);
    EXPECT_FALSE(solid.contains({0.1, 0.2, 0.3}));
    EXPECT_FALSE(solid.contains({2.0, 0.0, 0.0}));
}

TEST(CloudSolid, VolumeIsTheSameOnAnyNumberOfThreads)
{
    const PointCloud cloud = points_on("torus", 2000, SurfaceMethod::Random);
    const auto run = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return solid_of(cloud).volume();
    };
    const double one = run(1);
    EXPECT_EQ(run(2), one);
    EXPECT_EQ(run(7), one);
}

} // namespace
} // namespace meltpoint
