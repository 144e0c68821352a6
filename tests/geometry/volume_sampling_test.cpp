#include "geometry/volume_sampling.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/error.h"
#include "geometry/builtin_meshes.h"
#include "geometry/mesh_solid.h"
#include "geometry/relaxation.h"
#include "geometry/teapot.h"
#include "geometry/winding_number.h"

namespace meltpoint {
namespace {

constexpr double pi = std::numbers::pi;

double lattice_error(const VolumeSamples& samples)
{
    return double(samples.positions.size()) * std::pow(samples.spacing, 3) / samples.volume - 1.0;
}

void expect_ordered(const VolumeSamples& samples)
{
    const auto key = [](const glm::vec3& p) {
        return std::make_tuple(p.z, p.y, p.x);
    };
    for (std::size_t i = 1; i < samples.positions.size(); ++i) {
        ASSERT_LT(key(samples.positions[i - 1]), key(samples.positions[i]));
    }
}

/// The smallest distance of neighbors in the order of the samples: the spacing, on a cubic lattice.
double nearest_along_x(const VolumeSamples& samples)
{
    double nearest = std::numeric_limits<double>::max();
    for (std::size_t i = 1; i < samples.positions.size(); ++i) {
        nearest = std::min(nearest, double(glm::distance(samples.positions[i - 1], samples.positions[i])));
    }
    return nearest;
}

template <class Call>
std::string complaint(const Call& call)
{
    try {
        (void)call();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        return error.what();
    }
    return "";
}

TEST(VolumeSampling, ABlockIsFilledExactly)
{
    const Aabb block{{0.1f, 0.2f, 0.3f}, {1.1f, 0.7f, 0.55f}};
    const VolumeSamples samples = sample_block(block, 0.1);
    ASSERT_EQ(samples.positions.size(), 10u * 5u * 3u); // 2.5 layers along z become 3
    EXPECT_NEAR(samples.volume, 0.125, 1e-7);
    EXPECT_NEAR(samples.particle_volume, 0.125 / 150.0, 1e-9);
    EXPECT_NEAR(std::pow(samples.spacing, 3), samples.particle_volume, 1e-12);
    EXPECT_NEAR(glm::distance(samples.positions.front(), glm::vec3(0.15f, 0.25f, 0.3f + 0.25f / 6.0f)), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::distance(samples.positions.back(), glm::vec3(1.05f, 0.65f, 0.55f - 0.25f / 6.0f)), 0.0f, 1e-6f);
    expect_ordered(samples);
}

TEST(VolumeSampling, ABlockThatSpacingsFillKeepsTheSpacing)
{
    const VolumeSamples samples = sample_block({{0.0f, 0.0f, 0.0f}, {0.3f, 0.6f, 0.3f}}, 0.02);
    EXPECT_EQ(samples.positions.size(), 15u * 30u * 15u);
    EXPECT_NEAR(samples.spacing, 0.02, 1e-8);
}

TEST(VolumeSampling, ASphereHasItsVolumeAtAnySpacing)
{
    for (const double spacing : {0.2, 0.15, 0.1, 0.083, 0.05, 0.031}) {
        const VolumeSamples samples = sample_sphere({1.0f, -2.0f, 0.5f}, 1.0f, spacing);
        EXPECT_DOUBLE_EQ(samples.volume, 4.0 / 3.0 * pi);
        EXPECT_LE(std::abs(lattice_error(samples)), 0.002) << spacing;
        EXPECT_NEAR(samples.spacing / spacing, 1.0, 0.025 + 1e-9);
        EXPECT_NEAR(nearest_along_x(samples) / samples.spacing, 1.0, 1e-4);
        EXPECT_DOUBLE_EQ(samples.particle_volume, samples.volume / double(samples.positions.size()));
        for (const glm::vec3& p : samples.positions) {
            ASSERT_LE(glm::distance(p, glm::vec3(1.0f, -2.0f, 0.5f)), 1.0f + 1e-6f);
        }
        expect_ordered(samples);
    }
}

TEST(VolumeSampling, MeshesHaveTheirVolumeAtAnySpacing)
{
    for (const std::string_view name : {"sphere", "cube", "torus"}) {
        const TriangleMesh mesh = builtin_mesh(name);
        for (const double spacing : {0.15, 0.0731}) {
            const VolumeSamples samples = sample_volume(mesh, spacing);
            EXPECT_NEAR(samples.volume / signed_volume(mesh), 1.0, 5e-4) << name;
            EXPECT_LE(std::abs(lattice_error(samples)), 0.002) << name << " " << spacing;
            EXPECT_NEAR(samples.spacing / spacing, 1.0, 0.025 + 1e-9);
            expect_ordered(samples);
        }
    }
}

TEST(VolumeSampling, ACubeOfAnAwkwardEdgeDoesNotGetTooFewParticles)
{
    TriangleMesh cube = builtin_mesh("cube"); // 10.49 spacings: a plain clip would leave 10^3, each 15 % too heavy
    const VolumeSamples samples = sample_volume(cube, 1.0 / 10.49);
    EXPECT_LE(std::abs(lattice_error(samples)), 0.002);
}

TEST(VolumeSampling, EveryLatticeHasItsVolumeAndItsNeighbors)
{
    struct Expected {
        Lattice lattice;
        double nearest; // neighbor, in d: the cell of one particle has the volume d^3
        int neighbors;
    };
    const MeshSolid torus(builtin_mesh("torus"));
    for (const Expected& expected :
         {Expected{Lattice::Cubic, 1.0, 6}, Expected{Lattice::Bcc, 1.0911, 8}, Expected{Lattice::Fcc, 1.1225, 12}}) {
        const VolumeSamples samples = sample_volume(torus, {expected.lattice, PointSpacing{0.1}});
        EXPECT_LE(std::abs(lattice_error(samples)), 0.002);
        EXPECT_NEAR(samples.spacing, 0.1, 0.0025 + 1e-9);
        int most = 0;
        for (std::size_t i = 0; i < samples.positions.size(); i += 17) {
            int neighbors = 0;
            for (std::size_t j = 0; j < samples.positions.size(); ++j) {
                const double r = double(glm::distance(samples.positions[i], samples.positions[j])) / samples.spacing;
                neighbors += i != j && r < expected.nearest * 1.001 ? 1 : 0;
                ASSERT_TRUE(i == j || r > expected.nearest * 0.999) << r;
            }
            most = std::max(most, neighbors);
        }
        EXPECT_EQ(most, expected.neighbors);
    }
}

TEST(VolumeSampling, ACountIsMetWithinTwoPercent)
{
    const MeshSolid cube(builtin_mesh("cube"));
    const MeshSolid torus(builtin_mesh("torus"));
    const BallSolid ball({3.0f, 0.0f, 0.0f}, 0.1f);
    for (const Lattice lattice : {Lattice::Cubic, Lattice::Bcc, Lattice::Fcc}) {
        for (const std::size_t count : {1u, 5u, 100u, 1154u, 20'000u}) { // 1154: 10.49 layers in the cube
            for (const Solid* solid : {static_cast<const Solid*>(&cube), static_cast<const Solid*>(&torus),
                                       static_cast<const Solid*>(&ball)}) {
                const VolumeSamples samples = sample_volume(*solid, {lattice, PointCount{count}});
                EXPECT_NEAR(double(samples.positions.size()), double(count), 0.02 * double(count));
                EXPECT_LE(std::abs(lattice_error(samples)), 0.002) << count;
            }
        }
    }
    EXPECT_NE(complaint([&] {
                  return sample_volume(cube, {Lattice::Bcc, PointCount{0}});
              }).find("is 0"),
              std::string::npos);
    EXPECT_NE(complaint([&] {
                  return sample_volume(cube, {Lattice::Fcc, PointCount{std::size_t{1} << 40}});
              }).find("lattice points"),
              std::string::npos);
    EXPECT_NE(complaint([&] {
                  return sample_volume(cube, {Lattice::BlueNoise, PointCount{std::size_t{1} << 27}});
              }).find("candidates"),
              std::string::npos);
}

TEST(VolumeSampling, BlueNoiseHasItsCountAndIsEven)
{
    const BoxSolid box({{0.0f, 0.0f, 0.0f}, {1.0f, 2.0f, 1.0f}});
    const BallSolid ball({3.0f, 0.0f, 0.0f}, 0.1f);
    const MeshSolid torus(builtin_mesh("torus"));
    for (const Solid* solid :
         {static_cast<const Solid*>(&box), static_cast<const Solid*>(&ball), static_cast<const Solid*>(&torus)}) {
        for (const std::size_t count : {1u, 10u, 1500u}) {
            const VolumeSamples samples = sample_volume(*solid, {Lattice::BlueNoise, PointCount{count}, 4});
            ASSERT_EQ(samples.positions.size(), count);
            EXPECT_NEAR(lattice_error(samples), 0.0, 1e-9);
            const Evenness evenness = evenness_of(samples.positions, *solid);
            EXPECT_GE(evenness.relative_radius, 0.7) << count;
            EXPECT_LE(evenness.density_spread, 0.01) << count;
        }
    }
    const VolumeSamples spaced = sample_volume(box, {Lattice::BlueNoise, PointSpacing{0.1}});
    EXPECT_EQ(spaced.positions.size(), 2000u);
    EXPECT_NE(spaced.positions, sample_volume(box, {Lattice::BlueNoise, PointSpacing{0.1}, 2}).positions);
}

TEST(VolumeSampling, TheOpenTeapotIsFilledToItsVolume)
{
    const TriangleMesh mesh = teapot(8);
    const VolumeSamples samples = sample_volume(mesh, 0.2);
    EXPECT_LE(std::abs(lattice_error(samples)), 0.002);
    const Aabb box = bounds(mesh);
    for (const glm::vec3& p : samples.positions) {
        ASSERT_TRUE(box.contains(p));
        ASSERT_GE(winding_number_exact(mesh, glm::dvec3(p)), 0.5 - 0.01);
    }
}

TEST(VolumeSampling, BlueNoiseFillsOpenMeshesWithoutASpike)
{
    TriangleMesh bowl = builtin_mesh("sphere");
    std::erase_if(bowl.triangles, [&](const glm::uvec3& t) {
        return bowl.positions[t.x].y + bowl.positions[t.y].y + bowl.positions[t.z].y > 3.0f * 0.6f;
    });
    for (const TriangleMesh& mesh : {bowl, teapot(5)}) {
        const MeshSolid solid(mesh);
        const VolumeSamples samples = sample_volume(solid, {Lattice::BlueNoise, PointCount{1200}});
        ASSERT_EQ(samples.positions.size(), 1200u);
        const Aabb box = bounds(mesh);
        for (const glm::vec3& p : samples.positions) {
            ASSERT_TRUE(box.contains(p));
            ASSERT_GE(winding_number_exact(mesh, glm::dvec3(p)), 0.5 - 0.01);
        }
        const Evenness evenness = evenness_of(samples.positions, solid);
        EXPECT_GE(evenness.relative_radius, 0.7);
        EXPECT_LE(evenness.density_spread, 0.01);
    }
}

TEST(VolumeSampling, AnOverlapCountsOnce)
{
    TriangleMesh two = builtin_mesh("cube");
    const TriangleMesh other = two;
    for (const glm::vec3& position : other.positions) {
        two.positions.push_back(position + glm::vec3(0.37f, 0.0f, 0.0f));
    }
    for (const glm::uvec3& triangle : other.triangles) {
        two.triangles.push_back(triangle + 8u);
    }
    EXPECT_NEAR(measure_volume(two), 1.37, 1.37 * 1e-3);
    EXPECT_NEAR(signed_volume(two), 2.0, 1e-9);
}

TEST(VolumeSampling, IsTheSameOnAnyNumberOfThreads)
{
    const TriangleMesh mesh = builtin_mesh("torus");
    for (const Lattice lattice : {Lattice::Cubic, Lattice::Fcc, Lattice::BlueNoise}) {
        const auto run = [&](std::size_t threads) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            return sample_volume(MeshSolid(mesh), {lattice, PointCount{1000}});
        };
        const VolumeSamples one = run(1);
        for (const std::size_t threads : {2u, 7u}) {
            const VolumeSamples other = run(threads);
            ASSERT_EQ(one.positions.size(), other.positions.size());
            EXPECT_EQ(
                std::memcmp(one.positions.data(), other.positions.data(), one.positions.size() * sizeof(glm::vec3)), 0);
            EXPECT_EQ(one.volume, other.volume);
            EXPECT_EQ(one.spacing, other.spacing);
        }
    }
}

TEST(VolumeSampling, WhatCannotBeFilledIsRefused)
{
    const float infinity = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const TriangleMesh cube = builtin_mesh("cube");
    TriangleMesh inverted = cube;
    for (glm::uvec3& triangle : inverted.triangles) {
        std::swap(triangle.x, triangle.y);
    }
    TriangleMesh flat = cube;
    for (glm::vec3& position : flat.positions) {
        position.y = 0.0f;
    }
    TriangleMesh plate = cube;
    for (glm::vec3& position : plate.positions) {
        position.y *= 0.001f;
    }
    const Aabb unit{{0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f}};

    const std::string thin = complaint([&] { return sample_volume(plate, 0.05); });
    EXPECT_NE(thin.find("1 x 0.001 x 1 m"), std::string::npos) << thin;
    EXPECT_NE(thin.find("0.05 m"), std::string::npos) << thin;
    EXPECT_NE(complaint([&] { return sample_sphere({}, 0.01f, 0.1); }).find("too small"), std::string::npos);
    EXPECT_NE(complaint([&] {
                  return sample_block({{}, {1.0f, 0.01f, 1.0f}}, 0.1);
              }).find("too thin"),
              std::string::npos);
    EXPECT_NE(complaint([&] { return sample_volume(inverted, 0.1); }).find("face inward"), std::string::npos);
    EXPECT_NE(complaint([&] { return sample_volume(flat, 0.1); }).find("flat"), std::string::npos);
    EXPECT_NE(complaint([&] { return sample_volume({}, 0.1); }).find("no triangles"), std::string::npos);
    EXPECT_NE(complaint([&] { return sample_volume(cube, 1e-6); }).find("lattice points"), std::string::npos);
    EXPECT_NE(complaint([&] { return sample_block(unit, 1e-6); }).find("lattice points"), std::string::npos);
    EXPECT_NE(complaint([&] { return sample_sphere({}, 1e30f, 1e-30); }).find("lattice points"), std::string::npos);
    EXPECT_NE(complaint([&] { return sample_block({{}, {1.0f, infinity, 1.0f}}, 0.1); }), "");
    EXPECT_NE(complaint([&] { return sample_block({{}, {1.0f, nan, 1.0f}}, 0.1); }).find("empty"), std::string::npos);
    EXPECT_NE(complaint([&] { return sample_block({{1.0f, 1.0f, 1.0f}, {}}, 0.1); }).find("empty"), std::string::npos);
    for (const double spacing : {0.0, -1.0, double(nan), double(infinity)}) {
        EXPECT_NE(complaint([&] { return sample_volume(cube, spacing); }).find("must be positive"), std::string::npos);
        EXPECT_NE(complaint([&] { return sample_block(unit, spacing); }).find("must be positive"), std::string::npos);
        EXPECT_NE(complaint([&] { return sample_sphere({}, 1.0f, spacing); }).find("must be positive"),
                  std::string::npos);
    }
    for (const float radius : {0.0f, -1.0f, nan, infinity}) {
        EXPECT_NE(complaint([&] { return sample_sphere({}, radius, 0.1); }).find("radius"), std::string::npos);
    }
    EXPECT_NE(complaint([&] { return sample_sphere({nan, 0.0f, 0.0f}, 1.0f, 0.1); }).find("center"), std::string::npos);
}

} // namespace
} // namespace meltpoint
