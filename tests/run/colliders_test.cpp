// Colliders of a scene, and bodies that start in each other's place.
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "run/scene_particles.h"
#include "support/clouds.h"
#include "support/scratch_folder.h"

namespace meltpoint {
namespace {

constexpr std::uint64_t no_limit = 10'000'000;
constexpr float d = 0.1f;
constexpr float sunk =
    0.541f * d; ///< below the surfaces of solids, at H = 2 d (the Wendland kernel's boundary distance)

FluidBody block(const glm::vec3& min, const glm::vec3& max)
{
    FluidBody body;
    body.shape = BlockShape{min, max};
    return body;
}

/// A domain of 2 m x 2 m x 2 m around (0, 1, 0), spacing 0.1 m, a block of 1 m x 0.8 m x 1 m on the floor.
Scene block_scene()
{
    Scene scene;
    scene.name = "test";
    scene.particles.spacing = d;
    scene.fluids.push_back(block({-0.5f, 0.0f, -0.5f}, {0.5f, 0.8f, 0.5f}));
    return scene;
}

std::size_t count(const ParticleSet& particles, std::uint32_t state)
{
    std::size_t found = 0;
    for (const std::uint32_t attributes : particles.attributes) {
        found += shared::particle_state(attributes) == state ? 1 : 0;
    }
    return found;
}

/// Least distance of any two particles of which the first is fluid.
float least_distance(const ParticleSet& particles)
{
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < particles.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (!shared::is_boundary(particles.attributes[j])) {
                least = std::min(least, glm::distance(particles.position[i], particles.position[j]));
            }
        }
    }
    return least;
}

std::string refusal(const Scene& scene, std::uint64_t limit = no_limit)
{
    try {
        static_cast<void>(make_scene_particles(scene, limit));
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        return error.what();
    }
    return "";
}

TEST(SceneColliders, AreBoundaryParticlesAllOverTheSurface)
{
    Scene scene = block_scene();
    scene.colliders.push_back({.shape = SphereShape{{0.0f, 1.5f, 0.0f}, 0.4f}, .spacing = 0.5f, .friction = 2.0f});
    const auto [particles, notes, colliders] = make_scene_particles(scene, no_limit);
    EXPECT_TRUE(notes.empty());
    ASSERT_EQ(count(particles, shared::STATE_FLUID), 800u);
    const double area = 4.0 * std::numbers::pi * 0.4 * 0.4;
    EXPECT_NEAR(static_cast<double>(count(particles, shared::STATE_COLLIDER)), area / (0.05 * 0.05), 5.0);
    for (std::size_t i = 800; i < particles.size(); ++i) { // fluid first
        ASSERT_EQ(particles.attributes[i], shared::pack_attributes(shared::STATE_COLLIDER, 1));
        ASSERT_NEAR(glm::distance(particles.position[i], glm::vec3(0.0f, 1.5f, 0.0f)), 0.4f - sunk, 2e-3f);
        ASSERT_EQ(particles.mass[i], 0.0f);
        ASSERT_EQ(particles.velocity[i], glm::vec3(0.0f));
    }
}

TEST(SceneColliders, WhatIsOutsideOfTheDomainIsCutOff)
{
    Scene scene = block_scene();
    scene.fluids[0].shape = BlockShape{{-0.5f, 0.5f, -0.5f}, {0.5f, 0.8f, 0.5f}};
    scene.colliders.push_back({.shape = BlockShape{{-3.0f, 0.2f, -3.0f}, {3.0f, 0.2f, 3.0f}}, .spacing = 0.5f});
    const ParticleSet particles = make_particles(scene, no_limit);
    const double expected = 2.0 * 2.0 / (0.05 * 0.05); // a plate is one layer
    EXPECT_NEAR(static_cast<double>(count(particles, shared::STATE_COLLIDER)), expected, 0.03 * expected);
    for (std::size_t i = 300; i < particles.size(); ++i) {
        ASSERT_FLOAT_EQ(particles.position[i].y, 0.2f);
        ASSERT_LE(std::max(std::abs(particles.position[i].x), std::abs(particles.position[i].z)), 1.0f);
    }

    scene.colliders[0].shape = SphereShape{{0.0f, 4.0f, 0.0f}, 0.5f};
    EXPECT_TRUE(refusal(scene).starts_with("test: the surface of collider.0 lies outside the domain: in [-0.49"))
        << refusal(scene);
}

TEST(SceneColliders, TooManyBoundaryParticlesAreOneSentence)
{
    Scene scene = block_scene();
    scene.colliders.push_back({.shape = SphereShape{{0.0f, 1.5f, 0.0f}, 0.4f}, .spacing = 0.25f});
    EXPECT_NE(refusal(scene, 3000).find("collider.0 needs about 3217 boundary particles"), std::string::npos)
        << refusal(scene, 3000);
    EXPECT_NE(refusal(scene, 4000).find("about 4017 particles"), std::string::npos) << refusal(scene, 4000);
    scene.colliders.push_back(scene.colliders[0]);
    EXPECT_NE(refusal(scene, 5000).find("the colliders need 6434 boundary particles"), std::string::npos)
        << refusal(scene, 5000);
}

TEST(SceneColliders, FluidInAndAgainstASolidIsLeftOut)
{
    Scene scene = block_scene();
    ColliderBody ball{.shape = SphereShape{{0.0f, 0.4f, 0.0f}, 0.25f}};
    scene.colliders.push_back(ball);
    const auto [particles, notes, colliders] = make_scene_particles(scene, no_limit);
    const std::size_t fluid = count(particles, shared::STATE_FLUID);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(notes[0], std::to_string(800 - fluid) +
                            " of the 800 particles of fluid.0 would start in or against collider.0 and are left out");
    for (std::size_t i = 0; i < fluid; ++i) {
        // Fluid ends at the surface: half a spacing beyond its particles.
        ASSERT_GT(glm::distance(particles.position[i], glm::vec3(0.0f, 0.4f, 0.0f)), 0.25f + 0.45f * d);
        ASSERT_FLOAT_EQ(particles.mass[i], 1.0f);
    }
    const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(0.25 + 0.05, 3);
    EXPECT_NEAR(static_cast<double>(800 - fluid), volume / 1e-3, 30.0);
    EXPECT_GT(least_distance(particles), 0.9f * d);

    scene.colliders[0].solid = false; // a shell keeps what is inside
    scene.colliders[0].shape = SphereShape{{0.0f, 0.4f, 0.0f}, 0.35f};
    const ParticleSet filled = make_particles(scene, no_limit);
    std::size_t inside = 0;
    for (std::size_t i = 0; i < count(filled, shared::STATE_FLUID); ++i) {
        inside += glm::distance(filled.position[i], glm::vec3(0.0f, 0.4f, 0.0f)) < 0.35f ? 1 : 0;
    }
    EXPECT_GT(inside, 20u);
    EXPECT_GT(least_distance(filled), 0.9f * d);
}

TEST(SceneColliders, AMeshIsSolidWhereItsWindingNumberSaysSo)
{
    Scene scene = block_scene();
    ColliderBody cube;
    cube.shape = MeshShape{.mesh = "builtin:cube", .size = 0.6f, .position = {0.0f, 0.4f, 0.0f}};
    scene.colliders.push_back(cube);
    const ParticleSet particles = make_particles(scene, no_limit);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const glm::vec3 from_center = glm::abs(particles.position[i] - glm::vec3(0.0f, 0.4f, 0.0f));
        const float half = std::max({from_center.x, from_center.y, from_center.z});
        if (shared::is_boundary(particles.attributes[i])) {
            ASSERT_NEAR(half, 0.3f - 0.5f * sunk, 0.5f * sunk + 1e-4f); // its edges may be less deep
        } else {
            ASSERT_GE(half, 0.3f);
        }
    }
}

TEST(SceneColliders, AClosedMeshThatIsInsideOutIsWarnedOf)
{
    const test::ScratchFolder folder;
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    const std::string inward = corners + "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
    const std::string outward = corners + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    const std::string open = corners + "f 1 2 3\nf 1 4 2\nf 1 3 4\n";
    const auto warning_of = [&](const std::string& mesh, bool solid) {
        const std::string path = (folder / "mesh.obj").string();
        test::write_bytes(path, mesh);
        Scene scene = block_scene();
        scene.colliders.push_back({.shape = MeshShape{.mesh = path, .position = {0.0f, 1.4f, 0.0f}}, .solid = solid});
        testing::internal::CaptureStderr();
        static_cast<void>(make_particles(scene, no_limit));
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_EQ(warning_of(inward, true),
              "warning: test: the triangles of collider.0 face inward: fluid may start inside of it\n");
    EXPECT_EQ(warning_of(inward, false), "");
    EXPECT_EQ(warning_of(outward, true), "");
    EXPECT_EQ(warning_of(open, true), "");
}

TEST(SceneColliders, AClosedScanThatIsInsideOutIsWarnedOf)
{
    const test::ScratchFolder folder;
    const auto warning_of = [&](const PointCloud& cloud, bool solid) {
        const std::string path = (folder / "scan.xyz").string();
        test::write_bytes(path, test::xyz_of(cloud));
        Scene scene = block_scene();
        const MeshShape shape{.mesh = path, .size = 0.8f, .position = {0.0f, 1.4f, 0.0f}, .rotation = {30, 0, 50}};
        scene.colliders.push_back({.shape = shape, .solid = solid});
        testing::internal::CaptureStderr();
        static_cast<void>(make_particles(scene, no_limit));
        return testing::internal::GetCapturedStderr();
    };
    PointCloud outward = test::inward_sphere(1000);
    for (glm::vec3& normal : outward.normals) {
        normal = -normal;
    }
    EXPECT_EQ(warning_of(test::inward_sphere(1000), true),
              "warning: test: the normals of collider.0 face inward: fluid may start inside of it\n");
    EXPECT_EQ(warning_of(test::inward_sphere(1000), false), "");
    EXPECT_EQ(warning_of(outward, true), "");

    // What is open may face inward: a bowl, a pipe, a floor seen from below.
    PointCloud bowl;
    PointCloud pipe;
    PointCloud floor;
    for (const glm::vec3& x : test::fibonacci_sphere(3000).positions) {
        const glm::vec3 around = glm::normalize(glm::vec3(x.x, 0.0f, x.z));
        pipe.positions.push_back(around + glm::vec3(0.0f, x.y, 0.0f));
        pipe.normals.push_back(-around);
        floor.positions.emplace_back(x.x, 0.01f * x.y, x.z);
        floor.normals.emplace_back(0.0f, -1.0f, 0.0f);
        if (x.y < 0.0f) {
            bowl.positions.push_back(x);
            bowl.normals.push_back(-x);
        }
    }
    EXPECT_EQ(warning_of(bowl, true), "");
    EXPECT_EQ(warning_of(pipe, true), "");
    EXPECT_EQ(warning_of(floor, true), "");
}

// A scanned ball does what a ball does, wherever its own points lie.
TEST(SceneColliders, AScanIsSampledAnewAndSolid)
{
    const test::ScratchFolder folder;
    std::string text;
    for (const glm::vec3& x : test::fibonacci_sphere(3000).positions) {
        text += fmt::format("{} {} {} {} {} {}\n", 2.0f * x.x + 5.0f, 2.0f * x.y, 2.0f * x.z, x.x, x.y, x.z);
    }
    test::write_bytes(folder / "ball.xyz", text);
    Scene scene = block_scene();
    ColliderBody ball;
    ball.shape = MeshShape{
        .mesh = (folder / "ball.xyz").string(), .size = 0.5f, .position = {0, 0.4f, 0}, .rotation = {40, 50, 60}};
    scene.colliders.push_back(ball);
    const glm::vec3 center(0.0f, 0.4f, 0.0f);
    const ParticleSet particles = make_particles(scene, no_limit);
    const std::size_t fluid = count(particles, shared::STATE_FLUID);
    EXPECT_NEAR(static_cast<double>(particles.size() - fluid), 4.0 * std::numbers::pi * 0.25 * 0.25 / (0.07 * 0.07),
                8.0);
    const float sunk_radius = 0.25f - sunk;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const float r = glm::distance(particles.position[i], center);
        ASSERT_TRUE(i < fluid ? r > 0.25f + 0.45f * d : std::abs(r - sunk_radius) < 0.01f) << i << " " << r;
    }

    scene.colliders[0].solid = false;
    std::size_t inside = 0;
    for (const glm::vec3& x : make_particles(scene, no_limit).position) {
        inside += glm::distance(x, center) < 0.1f ? 1 : 0;
    }
    EXPECT_GT(inside, 0u);
}

TEST(SceneColliders, FilesThatCannotBeReadAreNamed)
{
    const test::ScratchFolder folder;
    Scene scene = block_scene();
    scene.colliders.emplace_back();
    for (const auto& [name, content] : {std::pair{"missing.obj", std::optional<std::string>()},
                                        {"empty.obj", ""},
                                        {"empty.ply", ""},
                                        {"empty.xyz", ""},
                                        {"missing.xyz", std::nullopt},
                                        {"line.xyz", "0 0 0\n1 0 0\n2 0 0\n3 0 0\n"},
                                        {"flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"}}) {
        if (content) {
            test::write_bytes(folder / name, *content);
        }
        scene.colliders[0].shape = MeshShape{.mesh = (folder / name).string(), .size = 1.0f};
        EXPECT_NE(refusal(scene).find(name), std::string::npos) << name << ": " << refusal(scene);
    }
}

TEST(SceneColliders, ASolidThatReachesOutOfTheDomainIsSolidUpToItsWalls)
{
    Scene scene = block_scene();
    scene.colliders.push_back({.shape = BlockShape{{-1.5f, -0.5f, -1.5f}, {0.0f, 2.5f, 1.5f}}});
    for (const glm::vec3& x : make_particles(scene, no_limit).position) {
        ASSERT_GE(x.x, -sunk - 1e-4f);
    }
}

TEST(SceneColliders, AFluidOfWhichNothingIsLeftIsRefused)
{
    Scene scene = block_scene();
    scene.colliders.push_back({.shape = BlockShape{{-0.9f, 0.0f, -0.9f}, {0.9f, 0.9f, 0.9f}}});
    EXPECT_EQ(refusal(scene), "test: 800 of the 800 particles of fluid.0 would start in or against collider.0 and are "
                              "left out, so nothing is left of it");
}

TEST(OverlappingFluids, TheEarlierOneKeepsItsPlace)
{
    Scene scene = block_scene();
    FluidBody oil;
    oil.shape = SphereShape{{0.13f, 0.82f, -0.08f}, 0.4f};
    oil.rest_density = 800.0f;
    scene.fluids.push_back(oil);
    const ParticleSet alone = make_particles(block_scene(), no_limit);
    const auto [particles, notes, colliders] = make_scene_particles(scene, no_limit);
    for (std::size_t i = 0; i < 800; ++i) {
        ASSERT_EQ(particles.position[i], alone.position[i]);
    }
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].find("particles of fluid.1 would start in fluid.0 and are left out"), std::string::npos)
        << notes[0];
    EXPECT_GT(least_distance(particles), 0.97f * d); // of neighbors in the ball: its lattice may be 2.5 % finer
    const auto left = static_cast<double>(particles.size() - 800);
    EXPECT_NEAR(left, 0.5 * 4.0 / 3.0 * std::numbers::pi * 64.0, 30.0); // half of the ball is above the block
    for (std::size_t i = 800; i < particles.size(); ++i) {
        ASSERT_NEAR(particles.mass[i], 0.8f, 0.06f); // as of the whole ball
    }
}

TEST(OverlappingFluids, NeighborsThatOnlyTouchAreWhole)
{
    Scene scene = block_scene();
    scene.fluids.push_back(block({-0.5f, 0.8f, -0.5f}, {0.5f, 1.2f, 0.5f}));
    scene.fluids.push_back(block({-0.45f, 1.2f, -0.47f}, {0.5f, 1.36f, 0.53f})); // its pitch differs from axis to axis
    const auto [particles, notes, colliders] = make_scene_particles(scene, no_limit);
    EXPECT_TRUE(notes.empty()) << notes[0];
    EXPECT_EQ(particles.size(), 800u + 400u + 9u * 2u * 10u);
}

// A block let into a larger one of the same lattice: no row of it is lost.
TEST(OverlappingFluids, OneLatticeHasNoGap)
{
    Scene scene = block_scene();
    scene.fluids.insert(scene.fluids.begin(), block({-0.2f, 0.2f, -0.2f}, {0.2f, 0.5f, 0.2f}));
    const auto [particles, notes, colliders] = make_scene_particles(scene, no_limit);
    EXPECT_EQ(particles.size(), 800u);
    EXPECT_NEAR(least_distance(particles), d, 1e-4f);
    EXPECT_EQ(notes.size(), 1u);
}

} // namespace
} // namespace meltpoint
