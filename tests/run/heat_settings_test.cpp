// What heat is told of a scene and its particles.
#include <gtest/gtest.h>

#include "run/heat_settings.h"
#include "run/scene_particles.h"
#include "scene/liquids.h"
#include "scene/materials.h"

namespace meltpoint {
namespace {

/// Ice at the melting point, water, an emitter and an iron plate.
Scene ice_and_water()
{
    Scene scene;
    scene.particles.spacing = 0.05f;
    SolidBody ice;
    ice.shape = BlockShape{{-0.2f, 0.0f, -0.2f}, {0.2f, 0.2f, 0.2f}};
    set_liquid(ice, *find_liquid("water"));
    ice.melts = true;
    scene.solids.push_back(ice);
    FluidBody water{.shape = BlockShape{{0.4f, 0.0f, -0.2f}, {0.6f, 0.2f, 0.2f}}};
    set_liquid(water, *find_liquid("water"));
    water.temperature = 50.0f;
    scene.fluids.push_back(water);
    EmitterBody jet{.shape = JetShape{{-0.7f, 1.0f, 0.0f}, 0.1f}, .velocity = {1.0f, 0.0f, 0.0f}, .particles = 50};
    set_liquid(jet.fluid, *find_liquid("water"));
    scene.emitters.push_back(jet);
    scene.colliders.push_back({.shape = BlockShape{{-0.8f, 0.0f, 0.5f}, {0.8f, 0.1f, 0.8f}}, .temperature = -30.0f});
    return scene;
}

TEST(HeatSettings, EnthalpyIsThatOfTemperatureAndState)
{
    Scene scene = ice_and_water();
    for (const float air : {20.0f, -5.0f}) { // an emitter's water is fluid even where it is at its melting point
        scene.heat.air_temperature = air;
        const ParticleSet set = make_particles(scene, 100'000);
        const auto settings = melting_settings(scene, set);
        ASSERT_TRUE(settings);
        ASSERT_EQ(settings->enthalpy.size(), set.size());
        std::size_t seen[5] = {};
        for (std::size_t i = 0; i < set.size(); ++i) {
            const double enthalpy = settings->enthalpy[i];
            const std::uint32_t state = shared::particle_state(set.attributes[i]);
            const std::uint32_t material = shared::particle_material(set.attributes[i]);
            ++seen[state];
            switch (state) {
            case shared::STATE_SOLID:
                EXPECT_EQ(enthalpy, air < 0.0f ? -5.0 * 2100.0 : 0.0);
                break;
            case shared::STATE_FLUID:
                EXPECT_EQ(enthalpy, 334e3 + 50.0 * 4186.0);
                break;
            case shared::STATE_DEAD:
                EXPECT_EQ(enthalpy, 334e3 + (air > 0.0f ? 20.0 * 4186.0 : 0.0));
                EXPECT_EQ(static_cast<double>(settings->params.birth_enthalpy[material]), enthalpy);
                break;
            default:
                EXPECT_EQ(shared::temperature(settings->heat.of[material], {enthalpy, 0.0f}), -30.0f);
                EXPECT_EQ(settings->heat.of[material].solid_conductivity, 50.0f);
            }
        }
        EXPECT_GT(seen[shared::STATE_SOLID] * seen[shared::STATE_FLUID] * seen[shared::STATE_COLLIDER], 0u);
        EXPECT_EQ(seen[shared::STATE_DEAD], 50u);
        EXPECT_EQ(set.release_time.size(), set.size());
    }
}

TEST(HeatSettings, OnlyWhatMeltsOrHasATemperatureHasHeat)
{
    Scene scene = ice_and_water();
    scene.solids[0].melts = false;
    EXPECT_TRUE(has_heat(scene)); // the water's temperature
    scene.fluids[0].temperature.reset();
    EXPECT_TRUE(has_heat(scene)); // the plate's
    scene.colliders[0].temperature.reset();
    EXPECT_FALSE(has_heat(scene));
    EXPECT_FALSE(melting_settings(scene, make_particles(scene, 100'000)));
    const std::size_t without = scene_materials(scene).materials.size();
    scene.solids[0].thermal.latent_heat *= 2.0f;
    EXPECT_EQ(scene_materials(scene).materials.size(), without); // what nobody asks for makes no material
}

} // namespace
} // namespace meltpoint
