// What a scene says of fragments.
#include "run/fragment_settings.h"

#include <gtest/gtest.h>

#include "scene/materials.h"
#include "scene/scene_file.h"

namespace meltpoint {
namespace {

Scene scene_with(const std::string& keys)
{
    return parse_scene("[[solid]]\nshape = \"block\"\nmin = [0, 0, 0]\nmax = [0.2, 0.2, 0.2]\n" + keys, "scene", ".",
                       {});
}

TEST(FragmentSettings, AnchorsAndFrictionAreThoseOfTheMaterials)
{
    Scene scene = scene_with("anchor = \"none\"\nsliding_friction = 0.3\n");
    scene.fluids.push_back({.shape = BlockShape{glm::vec3(0.3f), glm::vec3(0.5f)}});
    const auto settings = fragment_settings(scene);
    ASSERT_TRUE(settings.has_value());
    const SceneMaterials materials = scene_materials(scene);
    EXPECT_EQ(settings->params.anchor[materials.of_solid[0]], shared::ANCHOR_NONE);
    EXPECT_EQ(settings->params.sliding_friction[materials.of_solid[0]], 0.3f);
    EXPECT_EQ(settings->params.fluid_density, 1000.0f);
    EXPECT_EQ(settings->params.anchor[materials.of_fluid[0]], shared::ANCHOR_GROUND); // what freezes
}

TEST(FragmentSettings, OrdinarySolidsStandOnTheGround)
{
    EXPECT_EQ(fragment_settings(scene_with("")).value().params.anchor[0], shared::ANCHOR_GROUND);
}

TEST(FragmentSettings, NothingBreaksOffWhereAllHoldsItself)
{
    EXPECT_FALSE(fragment_settings(scene_with("anchor = \"all\"\n")).has_value());
    EXPECT_FALSE(fragment_settings(
                     parse_scene("[[fluid]]\nshape = \"block\"\nmin = [0, 0, 0]\nmax = [1, 1, 1]\n", "scene", ".", {}))
                     .has_value());
}

} // namespace
} // namespace meltpoint
