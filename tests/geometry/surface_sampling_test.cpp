#include "geometry/surface_sampling.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string_view>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/error.h"
#include "geometry/alias_table.h"
#include "geometry/builtin_meshes.h"
#include "geometry/point_cells.h"
#include "geometry/teapot.h"
#include "io/mesh_import.h"

namespace meltpoint {
namespace {

PointCloud random_points(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed)
{
    return sample_surface(mesh, {SurfaceMethod::Random, PointCount{count}, seed}).cloud;
}

/// Upper tail of the chi-square distribution by the cube-root normal approximation (Wilson & Hilferty 1931), good to a
/// few 1e-4 from 10 degrees of freedom on.
double chi_square_p(double statistic, double degrees)
{
    const double variance = 2.0 / (9.0 * degrees);
    const double z = (std::cbrt(statistic / degrees) - (1.0 - variance)) / std::sqrt(variance);
    return 0.5 * std::erfc(z / std::sqrt(2.0));
}

/// p of counts against weights, neighbors pooled until each bin expects at least five.
double goodness_of_fit(const std::vector<double>& weights, const std::vector<std::uint32_t>& drawn)
{
    std::vector<double> counts(weights.size());
    for (const std::uint32_t index : drawn) {
        counts[index] += 1.0;
    }
    double weight_sum = 0.0;
    for (const double weight : weights) {
        weight_sum += weight;
    }
    std::vector<std::pair<double, double>> bins; // expected, counted
    double expected = 0.0;
    double counted = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        expected += weights[i] / weight_sum * double(drawn.size());
        counted += counts[i];
        if (expected >= 5.0) {
            bins.emplace_back(expected, counted);
            expected = counted = 0.0;
        }
    }
    bins.back().first += expected;
    bins.back().second += counted;
    double statistic = 0.0;
    for (const auto& [e, c] : bins) {
        statistic += (c - e) * (c - e) / e;
    }
    return chi_square_p(statistic, double(bins.size()) - 1.0);
}

std::vector<double> areas_of(const TriangleMesh& mesh)
{
    std::vector<double> areas;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        areas.push_back(triangle_area(mesh, i));
    }
    return areas;
}

TEST(AliasTable, DrawsByWeightAndNeverTheWeightless)
{
    std::vector<double> weights;
    Random random(5);
    for (int i = 0; i < 200; ++i) {
        weights.push_back(i % 7 == 0 ? 0.0 : std::pow(10.0, 3.0 * random.uniform()));
    }
    const AliasTable table(weights);
    std::vector<std::uint32_t> drawn;
    for (int i = 0; i < 200'000; ++i) {
        drawn.push_back(table.draw(random));
        ASSERT_GT(weights[drawn.back()], 0.0);
    }
    const double p = goodness_of_fit(weights, drawn);
    EXPECT_GE(p, 0.001);
    EXPECT_LE(p, 0.999);
}

TEST(AliasTable, HandlesOneIndexAndExtremeRatios)
{
    Random random(6);
    EXPECT_EQ(AliasTable(std::vector<double>{3.0}).draw(random), 0u);
    const AliasTable table(std::vector<double>{1e-30, 1.0, 0.0, 1e-30});
    for (int i = 0; i < 10'000; ++i) {
        EXPECT_EQ(table.draw(random), 1u);
    }
}

TEST(SurfaceSampling, PointsPerTriangleFollowTheArea)
{
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        for (const TriangleMesh& mesh : {teapot(6), builtin_mesh("torus")}) {
            const double p = goodness_of_fit(areas_of(mesh), random_points(mesh, 200'000, seed).triangle);
            EXPECT_GE(p, 0.001) << "seed " << seed;
            EXPECT_LE(p, 0.999) << "seed " << seed;
        }
    }
}

TEST(SurfaceSampling, ColorsLieBetweenThoseOfTheCorners)
{
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    EXPECT_TRUE(random_points(mesh, 10, 1).colors.empty());
    mesh.colors = {{200, 0, 0}, {0, 200, 0}, {0, 0, 200}};
    const PointCloud cloud = random_points(mesh, 100, 1);
    ASSERT_EQ(cloud.colors.size(), 100u);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        EXPECT_NEAR(static_cast<float>(cloud.colors[i].g), 200.0f * cloud.positions[i].x, 0.51f);
        EXPECT_NEAR(static_cast<float>(cloud.colors[i].b), 200.0f * cloud.positions[i].y, 0.51f);
    }
}

TEST(SurfaceSampling, StratifiedPointsFollowTheAreaMoreCloselyThanChance)
{
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        for (const TriangleMesh& mesh : {teapot(6), builtin_mesh("torus")}) {
            const SurfaceSamples samples = sample_surface(mesh, {SurfaceMethod::Stratified, PointCount{50'000}, seed});
            ASSERT_EQ(samples.cloud.size(), 50'000u);
            EXPECT_GE(goodness_of_fit(areas_of(mesh), samples.cloud.triangle), 0.999) << "seed " << seed;
        }
    }
}

TEST(SurfaceSampling, ASpacingGivesEachPointItsSquare)
{
    const TriangleMesh cube = builtin_mesh("cube");
    for (const SurfaceMethod method : {SurfaceMethod::Random, SurfaceMethod::Stratified, SurfaceMethod::BlueNoise}) {
        const SurfaceSamples samples = sample_surface(cube, {method, PointSpacing{0.1}});
        EXPECT_EQ(samples.cloud.size(), 600u);
        EXPECT_DOUBLE_EQ(samples.area, 6.0);
        EXPECT_DOUBLE_EQ(samples.spacing, 0.1);
        EXPECT_EQ(sample_surface(cube, {method, PointSpacing{100.0}}).cloud.size(), 1u);
        EXPECT_EQ(sample_surface(cube, {method, PointCount{7}}).cloud.size(), 7u);
        EXPECT_THROW((void)sample_surface(cube, {method, PointSpacing{0.0}}), Error);
        EXPECT_THROW((void)sample_surface(cube, {method, PointSpacing{1e-9}}), Error);
    }
}

/// Smallest distance of two points, over that of the corners of equilateral triangles (2 r_max, Lagae & Dutre 2008).
/// Only pairs for which compare(i, j) holds.
template <class Compare>
double relative_radius(const SurfaceSamples& samples, const Compare& compare)
{
    const std::vector<glm::vec3>& points = samples.cloud.positions;
    const double densest = 2.0 * std::sqrt(samples.area / (2.0 * std::sqrt(3.0) * double(points.size())));
    const PointCells cells(points, densest);
    double nearest = densest;
    for (std::size_t place = 0; place < points.size(); ++place) {
        const std::uint32_t i = cells.order()[place];
        cells.visit_near(place, [&](std::uint32_t other) {
            const std::uint32_t j = cells.order()[other];
            if (i != j && compare(i, j)) {
                nearest = std::min(nearest, double(glm::distance(points[i], points[j])));
            }
        });
    }
    return nearest / densest;
}

TEST(SurfaceSampling, BlueNoiseKeepsItsDistance)
{
    const auto all = [](std::uint32_t, std::uint32_t) {
        return true;
    };
    for (const std::string_view name : {"sphere", "torus", "cube"}) {
        const TriangleMesh mesh = builtin_mesh(name);
        for (const std::size_t count : {100u, 4000u}) {
            for (const std::uint64_t seed : {1u, 2u, 3u}) {
                const SurfaceSamples samples =
                    sample_surface(mesh, {SurfaceMethod::BlueNoise, PointCount{count}, seed});
                ASSERT_EQ(samples.cloud.size(), count);
                EXPECT_GE(relative_radius(samples, all), 0.7) << name << " " << count << " " << seed;
            }
        }
    }
}

TEST(SurfaceSampling, BlueNoiseOfTheBunnyKeepsItsDistance)
{
    const std::filesystem::path file =
        std::filesystem::path(MELTPOINT_SOURCE_DIR) / "../shared/meshes/stanford-bunny.obj";
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << "there is no " << file;
    }
    const TriangleMesh bunny = import_mesh(file);
    const SurfaceSamples samples = sample_surface(bunny, {SurfaceMethod::BlueNoise, PointCount{10'000}});
    const auto same_side = [&](std::uint32_t i, std::uint32_t j) {
        return glm::dot(area_vector(bunny, samples.cloud.triangle[i]), area_vector(bunny, samples.cloud.triangle[j])) >
               0.0;
    };
    EXPECT_NEAR(samples.area, 0.0571288, 0.01 * 0.0571288);
    EXPECT_GE(relative_radius(samples, same_side), 0.7);
}

TEST(SurfaceSampling, BlueNoiseFollowsTheAreaMoreCloselyThanChance)
{
    const TriangleMesh torus = builtin_mesh("torus");
    const SurfaceSamples samples = sample_surface(torus, {SurfaceMethod::BlueNoise, PointCount{8000}});
    EXPECT_GE(goodness_of_fit(areas_of(torus), samples.cloud.triangle), 0.999);
}

TEST(SurfaceSampling, BothSidesOfAThinPlateAreCovered)
{
    TriangleMesh plate = builtin_mesh("cube");
    for (glm::vec3& position : plate.positions) {
        position.y *= 1e-3f;
    }
    const SurfaceSamples samples = sample_surface(plate, {SurfaceMethod::BlueNoise, PointCount{2000}});
    const std::vector<glm::vec3>& points = samples.cloud.positions;
    std::size_t above = 0;
    for (const glm::vec3& point : points) {
        above += point.y > 0.0f ? 1 : 0;
    }
    EXPECT_NEAR(double(above), 1000.0, 30.0);
    const auto same_side = [&](std::uint32_t i, std::uint32_t j) {
        return points[i].y * points[j].y > 0.0f;
    };
    EXPECT_GE(relative_radius(samples, same_side), 0.68); // the narrow sides disturb a little
}

TEST(SurfaceSampling, PointsAreUniformOnTheirTriangles)
{
    const std::size_t count = 200'000;
    const PointCloud cloud = random_points(builtin_mesh("cube"), count, 4);
    for (int axis = 0; axis < 2; ++axis) {
        std::vector<double> values;
        for (const glm::vec2& uv : cloud.barycentric) {
            ASSERT_GE(uv[axis], 0.0f);
            ASSERT_LE(uv.x + uv.y, 1.0f + 1e-6f);
            values.push_back(uv[axis]);
        }
        std::sort(values.begin(), values.end());
        // Kolmogorov-Smirnov: on a folded square each coordinate has the distribution 1 - (1 - u)^2.
        double largest_gap = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            const double expected = 1.0 - (1.0 - values[i]) * (1.0 - values[i]);
            largest_gap = std::max({largest_gap, std::abs(double(i + 1) / double(count) - expected),
                                    std::abs(double(i) / double(count) - expected)});
        }
        EXPECT_LT(largest_gap * std::sqrt(double(count)), 1.949); // p = 0.001
        EXPECT_GT(largest_gap * std::sqrt(double(count)), 0.36);  // p = 0.999
    }
}

TEST(SurfaceSampling, PointsLieWhereTheySayAndCarryTheNormal)
{
    const TriangleMesh sphere = builtin_mesh("sphere");
    const PointCloud cloud = random_points(sphere, 10'000, 5);
    ASSERT_EQ(cloud.size(), 10'000u);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const glm::uvec3& t = sphere.triangles[cloud.triangle[i]];
        const glm::vec2 uv = cloud.barycentric[i];
        const glm::vec3 expected =
            (1.0f - uv.x - uv.y) * sphere.positions[t.x] + uv.x * sphere.positions[t.y] + uv.y * sphere.positions[t.z];
        ASSERT_LT(glm::distance(cloud.positions[i], expected), 1e-6f);
        ASSERT_NEAR(glm::length(cloud.normals[i]), 1.0f, 1e-5f);
        ASSERT_LT(glm::distance(cloud.normals[i], glm::normalize(cloud.positions[i])), 2e-3f);
    }
}

TEST(SurfaceSampling, WithoutVertexNormalsOrAtCreasesTheTriangleSpeaks)
{
    TriangleMesh cube = builtin_mesh("cube");
    for (const bool creases : {false, true}) {
        cube.normals.assign(creases ? cube.positions.size() : 0, glm::vec3(0.0f));
        const PointCloud cloud = random_points(cube, 1000, 6);
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            const glm::vec3 normal = cloud.normals[i];
            ASSERT_FLOAT_EQ(glm::length(normal), 1.0f);
            ASSERT_NEAR(glm::dot(cloud.positions[i], normal), 0.5f, 1e-6f);
        }
    }
}

TEST(SurfaceSampling, IsTheSameOnAnyNumberOfThreads)
{
    const TriangleMesh mesh = builtin_mesh("torus");
    for (const SurfaceMethod method : {SurfaceMethod::Random, SurfaceMethod::Stratified, SurfaceMethod::BlueNoise}) {
        const auto run = [&](std::size_t threads, std::uint64_t seed) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            return sample_surface(mesh, {method, PointCount{5000}, seed}).cloud;
        };
        const PointCloud one = run(1, 7);
        for (const std::size_t threads : {2u, 7u}) {
            const PointCloud other = run(threads, 7);
            ASSERT_EQ(other.size(), one.size());
            EXPECT_EQ(std::memcmp(one.positions.data(), other.positions.data(), one.size() * sizeof(glm::vec3)), 0);
            EXPECT_EQ(std::memcmp(one.normals.data(), other.normals.data(), one.size() * sizeof(glm::vec3)), 0);
            EXPECT_EQ(one.triangle, other.triangle);
        }
        EXPECT_NE(run(1, 8).positions[0], one.positions[0]);
    }
}

TEST(SurfaceSampling, RandomPointsBeginWithTheSameWhateverTheirNumber)
{
    const TriangleMesh mesh = builtin_mesh("torus");
    EXPECT_EQ(random_points(mesh, 100, 7).positions[99], random_points(mesh, 20'000, 7).positions[99]);
}

TEST(SurfaceSampling, NoPointsAreNoPoints)
{
    for (const SurfaceMethod method : {SurfaceMethod::Random, SurfaceMethod::Stratified, SurfaceMethod::BlueNoise}) {
        EXPECT_EQ(sample_surface(builtin_mesh("cube"), {method, PointCount{0}}).cloud.size(), 0u);
    }
}

TEST(SurfaceSampling, AnAbsurdCountIsRefused)
{
    for (const SurfaceMethod method : {SurfaceMethod::Random, SurfaceMethod::Stratified, SurfaceMethod::BlueNoise}) {
        const SurfaceRequest request{method, PointCount{std::size_t{1} << 40}};
        EXPECT_THROW((void)sample_surface(builtin_mesh("cube"), request), Error);
    }
}

} // namespace
} // namespace meltpoint
