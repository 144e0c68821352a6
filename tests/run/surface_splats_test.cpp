// Surfaces of a scene as splats.
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "run/mesh_scene.h"
#include "run/surface_splats.h"
#include "scene/scene_check.h"
#include "scene/scene_file.h"

namespace meltpoint {
namespace {

constexpr std::uint64_t no_limit = 10'000'000;

Scene sphere_scene(std::uint32_t count)
{
    Scene scene;
    SurfaceBody surface;
    surface.shape = SphereShape{.center = {0.0f, 1.0f, 0.0f}, .radius = 0.5f};
    surface.count = count;
    surface.splat_radius = 2.0f;
    surface.color = {0.1f, 0.2f, 0.3f};
    scene.surfaces.push_back(surface);
    return scene;
}

TEST(SurfaceSplats, LieOnTheirSurfaceAndFaceOutward)
{
    const SurfaceSplats splats = make_surface_splats(sphere_scene(1000), no_limit);
    ASSERT_EQ(splats.position_radius.size(), 1000u);
    ASSERT_EQ(splats.normal.size(), 1000u);
    ASSERT_EQ(splats.color.size(), 1000u);
    // The area of a sphere of radius 0.5 is pi: spacing sqrt(pi / 1000), twice that as radius.
    const float radius = 2.0f * std::sqrt(3.14159f / 1000.0f);
    for (std::size_t i = 0; i < splats.normal.size(); ++i) {
        const glm::vec3 from_center = glm::vec3(splats.position_radius[i]) - glm::vec3(0.0f, 1.0f, 0.0f);
        EXPECT_NEAR(glm::length(from_center), 0.5f, 1e-3f);
        EXPECT_GT(glm::dot(glm::vec3(splats.normal[i]), glm::normalize(from_center)), 0.999f);
        EXPECT_NEAR(splats.position_radius[i].w, radius, 0.01f * radius);
        EXPECT_EQ(splats.color[i], glm::vec4(0.1f, 0.2f, 0.3f, 1.0f));
    }
}

TEST(SurfaceSplats, FollowTheSeedAndNothingElse)
{
    Scene scene = sphere_scene(300);
    const auto first = make_surface_splats(scene, no_limit).position_radius;
    EXPECT_EQ(make_surface_splats(scene, no_limit).position_radius, first);
    scene.seed = 2;
    EXPECT_NE(make_surface_splats(scene, no_limit).position_radius, first);
}

TEST(SurfaceSplats, MoreThanTheDeviceHoldsAreRefused)
{
    Scene scene = sphere_scene(300);
    scene.surfaces.push_back(scene.surfaces.front());
    try {
        static_cast<void>(make_surface_splats(scene, 599));
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("600 splats"), std::string::npos) << error.what();
    }
    EXPECT_EQ(make_surface_splats(scene, 600).normal.size(), 600u);
}

TEST(SurfaceSplats, ASceneOfSurfacesNeedsNoFluid)
{
    EXPECT_NO_THROW(validate_scene(sphere_scene(10)));
    Scene nothing;
    EXPECT_THROW(validate_scene(nothing), Error);
}

TEST(SurfaceSplats, KeysAreReadAndWritten)
{
    const Scene scene =
        parse_scene("[[surface]]\nshape = \"mesh\"\nmesh = \"builtin:torus\"\nposition = [0.0, 1.0, 0.0]\n"
                    "count = 77\nmethod = \"stratified\"\nsplat_radius = 0.5\n",
                    "test.toml", {});
    ASSERT_EQ(scene.surfaces.size(), 1u);
    EXPECT_EQ(scene.surfaces[0].count, 77u);
    EXPECT_EQ(scene.surfaces[0].method, SplatMethod::Stratified);
    EXPECT_EQ(write_scene(parse_scene(write_scene(scene), "again", {})), write_scene(scene));
}

TEST(ReplaceMeshes, TakesThePlaceOfEveryMesh)
{
    Scene scene = builtin_scene("bunny_samples");
    EXPECT_EQ(replace_meshes(scene, "other.obj"), 3u);
    EXPECT_EQ(std::get<MeshShape>(scene.surfaces[2].shape).mesh, "other.obj");
    EXPECT_EQ(std::get<MeshShape>(scene.surfaces[2].shape).size, 1.0f);
    Scene without = builtin_scene("drop");
    EXPECT_EQ(replace_meshes(without, "other.obj"), 0u);
}

} // namespace
} // namespace meltpoint
