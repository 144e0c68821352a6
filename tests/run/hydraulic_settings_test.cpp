// What a scene says of hydraulic erosion, and what physics says of sand in water.
#include "run/hydraulic_settings.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "run/frame_statistics.h"
#include "run/scene_particles.h"
#include "scene/scene_check.h"

namespace meltpoint {
namespace {

Grains quartz(double size)
{
    return {.size = size, .density = 2650.0, .fluid_density = 1000.0, .viscosity = 1.0e-3, .gravity = 9.81};
}

TEST(Shields, AQuarterMillimeterOfQuartzMovesAtAKnownStress)
{
    EXPECT_NEAR(dimensionless_grain_size(quartz(0.25e-3)), 6.3, 0.05);
    EXPECT_NEAR(shields_threshold(quartz(0.25e-3)), 0.17, 0.01);
}

TEST(Shields, CoarseGrainsHaveAConstantParameter)
{
    const Grains gravel = quartz(0.05);
    EXPECT_NEAR(shields_threshold(gravel) / (1650.0 * 9.81 * 0.05), 0.055, 0.001);
}

std::vector<glm::vec3> places()
{
    Random random(4);
    std::vector<glm::vec3> places;
    for (int i = 0; i < 2000; ++i) {
        places.emplace_back(random.uniform(), random.uniform(), random.uniform());
    }
    return places;
}

TEST(Strength, StaysWithinItsContrastAndReachesIt)
{
    const std::vector<float> found = strengths({.strength_contrast = 4.0f, .strength_grain = 0.1f}, places(), 1);
    EXPECT_GE(*std::ranges::min_element(found), 0.25f);
    EXPECT_LE(*std::ranges::max_element(found), 4.0f);
    EXPECT_LT(*std::ranges::min_element(found), 0.4f);
    EXPECT_GT(*std::ranges::max_element(found), 2.5f);
}

TEST(Strength, OfLayersDependsOnTheWayAcrossThemAlone)
{
    const Erodibility layers{
        .strength_contrast = 4.0f, .strength_grain = 0.1f, .strength_layers = glm::vec3(0.0f, 3.0f, 0.0f)};
    std::vector<glm::vec3> moved = places();
    for (glm::vec3& x : moved) {
        x += glm::vec3(0.3f, 0.0f, -0.7f);
    }
    EXPECT_EQ(strengths(layers, places(), 1), strengths(layers, moved, 1));
    EXPECT_NE(strengths(layers, places(), 1), strengths(layers, places(), 2));
}

TEST(HydraulicSettings, AreThoseOfEachSolid)
{
    Scene scene;
    scene.particles.spacing = 0.05f;
    scene.fluids.push_back({.shape = BlockShape{{-0.5f, 0.5f, -0.5f}, {0.5f, 1.0f, 0.5f}}, .viscosity = 1e-3f});
    EXPECT_FALSE(hydraulic_settings(scene, make_particles(scene, 100'000)));
    SolidBody sand;
    sand.shape = BlockShape{{-0.5f, 0.0f, -0.5f}, {0.5f, 0.25f, 0.5f}};
    sand.rest_density = 2650.0f;
    sand.erosion = {.erodes = true, .threshold = 99.0f, .grain_size = 0.25e-3f, .rate = 7.0f, .deposits = false};
    scene.solids.push_back(sand);
    sand.shape = BlockShape{{-0.5f, 0.25f, -0.5f}, {0.5f, 0.5f, 0.5f}};
    sand.erosion.grain_size.reset();
    sand.erosion.strength_contrast = 5.0f;
    sand.erosion.strength_grain = 0.2f;
    sand.erosion.deposits = true;
    scene.solids.push_back(sand);
    validate_scene(scene);
    const ParticleSet particles = make_particles(scene, 100'000);
    const auto settings = hydraulic_settings(scene, particles);
    ASSERT_TRUE(settings);
    const auto material = [&](const glm::vec3& low, const glm::vec3& high) {
        for (std::size_t i = 0; i < particles.size(); ++i) {
            if (glm::all(glm::greaterThan(particles.position[i], low)) &&
                glm::all(glm::lessThan(particles.position[i], high))) {
                return shared::particle_material(particles.attributes[i]);
            }
        }
        return 99u;
    };
    const std::uint32_t water = material({-1.0f, 0.5f, -1.0f}, {1.0f, 1.0f, 1.0f});
    const std::uint32_t loose = material({-1.0f, 0.0f, -1.0f}, {1.0f, 0.25f, 1.0f});
    const std::uint32_t rock = material({-1.0f, 0.25f, -1.0f}, {1.0f, 0.5f, 1.0f});
    EXPECT_EQ(settings->params.erodes[water], 0u);
    EXPECT_EQ(settings->params.erodes[loose], 1u);
    EXPECT_EQ(settings->params.deposits[loose], 0u);
    EXPECT_EQ(settings->params.deposits[rock], 1u);
    EXPECT_NEAR(settings->params.threshold[loose], 0.17f, 0.01f);
    EXPECT_EQ(settings->params.threshold[rock], 99.0f);
    EXPECT_EQ(settings->params.rate[rock], 7.0f);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const bool varies = shared::particle_material(particles.attributes[i]) == rock;
        EXPECT_EQ(varies, settings->strength[i] != 1.0f);
    }
}

TEST(HydraulicSettings, GrainsMustBeHeavierThanTheirFluid)
{
    Scene scene;
    SolidBody sand;
    sand.shape = BlockShape{{-0.5f, 0.0f, -0.5f}, {0.5f, 0.25f, 0.5f}};
    sand.rest_density = 1000.0f;
    sand.erosion = {.erodes = true, .grain_size = 1e-3f};
    scene.solids.push_back(sand);
    EXPECT_THROW(validate_scene(scene), Error); // no fluid at all
    scene.fluids.push_back({.shape = BlockShape{{-0.5f, 0.5f, -0.5f}, {0.5f, 1.0f, 0.5f}}});
    EXPECT_THROW(validate_scene(scene), Error);
    scene.solids[0].rest_density = 1100.0f;
    validate_scene(scene);
}

TEST(FrameStatistics, FreedMassIsOfWhatIsSolidNoMoreByItsCause)
{
    ParticleSet set;
    set.resize(4);
    const std::uint32_t freed = shared::freed_as(0, shared::STATE_FLUID, shared::CAUSE_HYDRAULIC);
    set.attributes = {freed, shared::with_state(freed, shared::STATE_SOLID),
                      shared::with_state(freed, shared::STATE_DEAD), shared::pack_attributes(shared::STATE_FLUID, 0)};
    set.mass = {1.0f, 2.0f, 4.0f, 8.0f};
    shared::SphParams params{};
    params.rest_density[0] = 1000.0f;
    const FrameStatistics statistics = measure(set, params);
    EXPECT_EQ(statistics.freed_mass[shared::CAUSE_HYDRAULIC], 5.0);
    EXPECT_EQ(statistics.freed_mass[shared::CAUSE_MELT], 0.0);
}

} // namespace
} // namespace meltpoint
