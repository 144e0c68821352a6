// Scenes of two dimensions, and of periodic axes.
#include "run/plane_scene.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "core/error.h"
#include "run/fluid_settings.h"
#include "run/frame_view.h"
#include "run/scene_particles.h"

namespace meltpoint {
namespace {

constexpr std::uint64_t no_limit = 10'000'000;

/// A square of 2 m, a block on its floor and a disk above, spacing 0.05 m.
Scene flat_scene()
{
    Scene scene;
    scene.name = "flat";
    scene.domain.dimensions = 2;
    scene.domain.min = glm::vec3(-1.0f, 0.0f, 5.0f); // z means nothing
    scene.domain.max = glm::vec3(1.0f, 2.0f, 5.0f);
    scene.particles.spacing = 0.05f;
    scene.fluids.push_back({.shape = BlockShape{{-1.0f, 0.0f, 3.0f}, {0.0f, 0.5f, 3.0f}}});
    scene.fluids.push_back({.shape = SphereShape{{0.0f, 1.5f, 4.0f}, 0.3f}, .rest_density = 800.0f});
    return scene;
}

TEST(PlaneScene, ParticlesLieInThePlaneAndHoldTheMass)
{
    const SceneParticles made = make_scene_particles(flat_scene(), no_limit);
    const ParticleSet& set = made.particles;
    double mass = 0.0;
    for (std::size_t i = 0; i < set.size(); ++i) {
        EXPECT_EQ(set.position[i].z, 0.0f);
        mass += static_cast<double>(set.mass[i]);
    }
    EXPECT_NEAR(mass, 1000.0 * 0.5 + 800.0 * std::numbers::pi * 0.09, 1e-2);
    EXPECT_NEAR(static_cast<double>(set.size()), 200.0 + std::numbers::pi * 0.09 / 0.0025, 6.0);
}

TEST(PlaneScene, SettingsAreThoseOfAPlane)
{
    const Scene scene = flat_scene();
    const FluidSettings settings = fluid_settings(scene, make_particles(scene, no_limit));
    EXPECT_EQ(settings.simulation.options.dimensions, 2u);
    EXPECT_EQ(settings.simulation.params.wall_mask, 0x0fu);
    EXPECT_EQ(sim::complete_params(settings.simulation.params, 1).grid_size.z, 1u);
    EXPECT_NEAR(settings.simulation.params.lattice_volume, 0.0025, 1e-8);
}

TEST(PlaneScene, CollidersAreOutlines)
{
    Scene scene = flat_scene();
    scene.fluids.resize(1);
    scene.colliders.push_back({.shape = SphereShape{{0.5f, 0.5f, 1.0f}, 0.3f}});
    scene.colliders.push_back({.shape = BlockShape{{-0.6f, 0.0f, 0.0f}, {-0.4f, 0.3f, 0.0f}}}); // in the fluid
    const SceneParticles made = make_scene_particles(scene, no_limit);
    ASSERT_EQ(made.colliders.size(), 2u);
    for (const glm::vec3& x : made.colliders[0].points) {
        EXPECT_EQ(x.z, 0.0f);
        EXPECT_NEAR(glm::distance(glm::vec2(x), glm::vec2(0.5f)), 0.3f - 0.025f, 0.01f); // half a spacing inside
    }
    for (const glm::vec3& x : made.colliders[1].points) {
        EXPECT_GT(x.x, -0.6f);
        EXPECT_LT(x.x, -0.4f);
        EXPECT_LT(x.y, 0.3f);
        EXPECT_GE(x.y, 0.0f);
    }
    ASSERT_EQ(made.notes.size(), 1u); // no fluid in the block
    for (std::size_t i = 0; i < made.particles.size(); ++i) {
        const glm::vec3 x = made.particles.position[i];
        const bool inside = x.x > -0.6f && x.x < -0.4f && x.y < 0.3f;
        EXPECT_FALSE(inside && shared::particle_state(made.particles.attributes[i]) == shared::STATE_FLUID);
    }
}

TEST(PlaneScene, IsSeenFromTheFront)
{
    const Scene scene = flat_scene();
    const FluidSettings settings = fluid_settings(scene, make_particles(scene, no_limit));
    const render::FrameSettings frame = frame_settings(scene, settings.simulation.params);
    EXPECT_FALSE(frame.floor.has_value());
    EXPECT_TRUE(frame.box);
}

TEST(PlaneScene, AMeshIsRefused)
{
    Scene scene = flat_scene();
    scene.fluids[0].shape = MeshShape{.mesh = "builtin:cube", .position = glm::vec3(0.0f)};
    EXPECT_THROW(static_cast<void>(make_particles(scene, no_limit)), Error);
}

TEST(PeriodicScene, HasImagesInsteadOfWalls)
{
    Scene scene = flat_scene();
    scene.domain.periodic = {true, false, false};
    const FluidSettings settings = fluid_settings(scene, make_particles(scene, no_limit));
    EXPECT_EQ(settings.simulation.params.periodic_mask, 0x03u);
    EXPECT_EQ(settings.simulation.params.wall_mask, 0x0cu);
    scene.domain.walls = false;
    const FluidSettings open = fluid_settings(scene, make_particles(scene, no_limit));
    EXPECT_EQ(open.simulation.params.wall_mask, 0u);
    scene.domain.max.x = -0.85f;
    scene.fluids = {{.shape = BlockShape{{-1.0f, 0.0f, 3.0f}, {-0.85f, 0.5f, 3.0f}}}};
    EXPECT_THROW(static_cast<void>(fluid_settings(scene, make_particles(scene, no_limit))), Error);
}

TEST(PeriodicScene, ColliderAcrossTheBorderComesInAgain)
{
    Scene scene = flat_scene();
    scene.domain.periodic = {true, false, false};
    scene.fluids = {{.shape = BlockShape{{-1.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 0.0f}}}};
    scene.colliders.push_back({.shape = SphereShape{{0.95f, 0.5f, 0.0f}, 0.2f}});
    const SceneParticles made = make_scene_particles(scene, no_limit);
    std::size_t left = 0;
    for (const glm::vec3& x : made.colliders[0].points) {
        EXPECT_TRUE(x.x >= -1.0f && x.x <= 1.0f);
        left += x.x < 0.0f ? 1 : 0;
    }
    EXPECT_GT(left, 5u);
    EXPECT_LT(left, made.colliders[0].points.size() / 2);
    for (std::size_t i = 0; i < made.particles.size(); ++i) { // and takes the fluid's place there
        const glm::vec2 x(made.particles.position[i]);
        if (shared::particle_state(made.particles.attributes[i]) == shared::STATE_FLUID) {
            EXPECT_GT(glm::distance(x, glm::vec2(0.95f, 0.5f)), 0.2f);
            EXPECT_GT(glm::distance(x, glm::vec2(-1.05f, 0.5f)), 0.2f);
        }
    }
}

/// The sentence that refuses a scene.
std::string refusal_of(const Scene& scene)
{
    try {
        static_cast<void>(make_particles(scene, no_limit));
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

// Fluid would start inside of it.
TEST(PeriodicScene, ColliderFarOutsideIsRefused)
{
    Scene scene = flat_scene();
    scene.domain.periodic = {true, false, false};
    scene.fluids = {{.shape = BlockShape{{-1.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 0.0f}}}};
    const auto refusal_at = [&](float x) {
        scene.colliders = {{.shape = SphereShape{{x, 0.5f, 0.0f}, 0.3f}}};
        return refusal_of(scene);
    };
    for (const float x : {-1.25f, -0.9f, 0.9f, 1.25f}) {
        EXPECT_EQ(refusal_at(x), "") << x;
    }
    for (const float x : {-3.0f, -1.4f, 1.4f, 3.0f, 7.0f}) {
        EXPECT_NE(refusal_at(x).find("m along x, which is periodic from -1 to 1 m: it must touch the domain"),
                  std::string::npos)
            << x;
    }
    scene.colliders = {{.shape = SphereShape{{0.0f, 5.0f, 0.0f}, 4.5f}}}; // from -4.5 on
    EXPECT_NE(refusal_of(scene).find("at most one period beyond it"), std::string::npos);
    scene.colliders = {{.shape = BlockShape{{-9.0f, 0.0f, 0.0f}, {9.0f, 0.2f, 0.0f}}}}; // without ends
    EXPECT_EQ(refusal_of(scene), "");
}

TEST(PeriodicScene, ColliderFromBorderToBorderHasNoEnds)
{
    Scene scene = flat_scene();
    scene.domain.periodic = {true, false, false};
    scene.fluids = {{.shape = BlockShape{{-1.0f, 0.3f, 0.0f}, {1.0f, 1.0f, 0.0f}}}};
    scene.colliders.push_back({.shape = BlockShape{{-1.0f, 0.0f, 0.0f}, {1.0f, 0.2f, 0.0f}}});
    const SceneParticles made = make_scene_particles(scene, no_limit);
    ASSERT_FALSE(made.colliders[0].points.empty());
    for (const glm::vec3& x : made.colliders[0].points) {
        EXPECT_NEAR(x.y, 0.175f, 0.01f); // a line along its upper side alone
    }
}

} // namespace
} // namespace meltpoint
