// What a scene says that does not do what it seems to.
#include "run/scene_warnings.h"

#include <tuple>

#include <gtest/gtest.h>

#include "run/scene_particles.h"

namespace meltpoint {
namespace {

/// A square of 1 m full of fluid.
Scene full_square()
{
    Scene scene;
    scene.domain.dimensions = 2;
    scene.domain.min = glm::vec3(0.0f);
    scene.domain.max = glm::vec3(1.0f);
    scene.particles.spacing = 0.05f;
    scene.fluids.push_back({.shape = BlockShape{glm::vec3(0.0f), glm::vec3(1.0f)}});
    return scene;
}

/// The only warning; empty where there is none.
std::string warning_of(const Scene& scene)
{
    const std::vector<std::string> warnings = scene_warnings(scene, make_particles(scene, 1'000'000));
    EXPECT_LE(warnings.size(), 1u);
    return warnings.empty() ? "" : warnings.front();
}

TEST(SceneWarnings, TensionAtASupportItIsNotMeasuredFor)
{
    Scene scene = full_square();
    scene.fluids[0].surface_tension = 0.07f;
    for (const auto& [dimensions, ratio, warns] : {std::tuple{2u, 3.0f, true},
                                                   {2u, 2.5f, false},
                                                   {2u, 2.0f, true},
                                                   {3u, 3.0f, true},
                                                   {3u, 2.5f, false},
                                                   {3u, 1.8f, false},
                                                   {3u, 1.7f, true}}) {
        scene.domain.dimensions = dimensions;
        scene.particles.support_ratio = ratio;
        EXPECT_EQ(warning_of(scene).starts_with("particles.support_ratio is"), warns) << dimensions << ", " << ratio;
    }
    scene.particles.support_ratio = 3.0f;
    scene.fluids[0].surface_tension = 0.0f;
    EXPECT_EQ(warning_of(scene), "");
}

TEST(SceneWarnings, TensionThatThePapersModelDoesNotRead)
{
    Scene scene = full_square();
    scene.particles.support_ratio = 2.5f;
    scene.fluids[0].shape = BlockShape{glm::vec3(0.0f), glm::vec3(0.5f, 1.0f, 1.0f)};
    scene.fluids.push_back({.shape = BlockShape{glm::vec3(0.5f, 0.0f, 0.0f), glm::vec3(1.0f)}});
    scene.fluids[1].surface_tension = 0.07f;
    EXPECT_EQ(warning_of(scene), "");
    scene.physics.tension_model = TensionModel::Paper;
    EXPECT_TRUE(warning_of(scene).starts_with("fluid.1.surface_tension does nothing")) << warning_of(scene);
    scene.physics.surface_tension = 0.07f;
    EXPECT_TRUE(warning_of(scene).starts_with("fluid.1.surface_tension does nothing")) << warning_of(scene);
    scene.fluids[1].surface_tension = 0.0f;
    EXPECT_EQ(warning_of(scene), "");
}

TEST(SceneWarnings, AContactAngleWithoutTension)
{
    Scene scene = full_square();
    scene.particles.support_ratio = 2.5f;
    scene.domain.contact_angle = 60.0f;
    EXPECT_TRUE(warning_of(scene).starts_with("domain.contact_angle does nothing, for no fluid")) << warning_of(scene);
    scene.domain.contact_angle = 90.0f;
    EXPECT_EQ(warning_of(scene), "");

    scene.colliders.resize(2, {.shape = BlockShape{glm::vec3(0.4f), glm::vec3(0.6f)}});
    EXPECT_EQ(warning_of(scene), "");
    scene.colliders[1].contact_angle = 120.0f;
    EXPECT_TRUE(warning_of(scene).starts_with("collider.1.contact_angle does nothing, for no fluid"))
        << warning_of(scene);
    scene.fluids[0].liquid = "water"; // its drops are finer than these particles
    EXPECT_TRUE(warning_of(scene).starts_with("collider.1.contact_angle does nothing, for no fluid"))
        << warning_of(scene);
    scene.fluids[0].surface_tension = 0.07f;
    EXPECT_EQ(warning_of(scene), "");
    scene.fluids[0].surface_tension.reset();
    scene.physics.tension_model = TensionModel::Paper;
    EXPECT_NE(warning_of(scene).find("where physics.tension_model is \"paper\""), std::string::npos)
        << warning_of(scene);
}

TEST(SceneWarnings, PressureBelowZeroThatDfsphDoesNotHave)
{
    Scene scene = full_square();
    scene.physics.clamp_pressure = false;
    for (const auto& [solver, warns] : {std::pair{Solver::Wcsph, false}, {Solver::Dfsph, true}, {Solver::Pbf, false}}) {
        scene.solver = solver;
        EXPECT_EQ(warning_of(scene).starts_with("physics.clamp_pressure is off"), warns);
    }
    scene.solver = Solver::Dfsph;
    scene.physics.clamp_pressure = true;
    EXPECT_EQ(warning_of(scene), "");
}

TEST(SceneWarnings, ALidWithoutWallViscosity)
{
    Scene scene = full_square();
    EXPECT_EQ(warning_of(scene), "");
    scene.domain.lid_velocity.x = 1.0f;
    EXPECT_TRUE(warning_of(scene).starts_with("domain.lid_velocity drags nothing along")) << warning_of(scene);
    scene.domain.wall_viscosity = 1.0f;
    EXPECT_EQ(warning_of(scene), "");
}

TEST(SceneWarnings, AFallWithoutEnd)
{
    Scene scene = full_square();
    scene.domain.periodic.x = true;
    EXPECT_EQ(warning_of(scene), ""); // onto the floor
    scene.physics.gravity = {0.5f, 0.0f, 0.0f};
    EXPECT_TRUE(warning_of(scene).starts_with("physics.gravity pulls along x, which is periodic")) << warning_of(scene);
    scene.physics.speed_of_sound = 20.0f;
    EXPECT_EQ(warning_of(scene), "");
    scene.physics.speed_of_sound.reset();
    scene.solver = Solver::Dfsph;
    EXPECT_EQ(warning_of(scene), "");
}

TEST(SceneWarnings, SandThatNothingMovesOrHolds)
{
    Scene scene;
    SolidBody sand;
    sand.shape = BlockShape{glm::vec3(0.2f), glm::vec3(0.8f)};
    sand.wind_erodes = true;
    scene.solids.push_back(sand);
    scene.solver = Solver::Dfsph;
    scene.wind.friction_velocity = 0.5f;
    EXPECT_EQ(warning_of(scene), ""); // there is no fluid that it could meet
    scene.solids[0].anchor = SolidAnchor::None;
    EXPECT_TRUE(warning_of(scene).starts_with("solid.0.anchor does nothing")) << warning_of(scene);
    scene.solids[0].anchor = SolidBody{}.anchor;
    scene.wind.flux = 0.0f;
    EXPECT_TRUE(warning_of(scene).starts_with("wind.flux is 0")) << warning_of(scene);
    scene.wind.flux = 1.8f;
    scene.solids[0].erosion.grain_size = 5.0f;
    EXPECT_TRUE(warning_of(scene).starts_with("the wind takes none of the sand with grains of 5 m"))
        << warning_of(scene);
    scene.wind.friction_velocity = 0.0f;
    EXPECT_EQ(warning_of(scene), "");
}

TEST(SceneWarnings, ShiftingAtAFreeSurface)
{
    Scene scene = full_square();
    scene.physics.shifting = 5.0f;
    EXPECT_EQ(warning_of(scene), "");
    scene.fluids[0].shape = BlockShape{glm::vec3(0.0f), glm::vec3(1.0f, 0.8f, 1.0f)};
    scene.fluids[0].rest_density = 800.0f; // its volume counts
    EXPECT_NE(warning_of(scene).find("this fills 0.8 of it"), std::string::npos) << warning_of(scene);
    scene.domain.dimensions = 3;
    EXPECT_NE(warning_of(scene).find("this fills 0.8 of it"), std::string::npos) << warning_of(scene);
    scene.physics.shifting = 0.0f;
    EXPECT_EQ(warning_of(scene), "");
}

TEST(SceneWarnings, BodiesOnFluidThatCannotGetOutOfTheirWay)
{
    Scene scene = full_square();
    scene.fluids[0].shape = BlockShape{glm::vec3(0.0f), glm::vec3(1.0f, 0.4f, 1.0f)};
    SolidBody body;
    body.shape = BlockShape{{0.2f, 0.4f, 0.0f}, {0.6f, 0.8f, 1.0f}};
    body.anchor = SolidAnchor::None;
    scene.solids.push_back(body);
    for (const auto& [solver, well, too_dense] :
         {std::tuple{Solver::Dfsph, 4900.0f, 5100.0f}, {Solver::Pbf, 1900.0f, 2100.0f}}) {
        scene.solver = solver;
        scene.solids[0].rest_density = well;
        EXPECT_EQ(warning_of(scene), "");
        scene.solids[0].rest_density = too_dense;
        EXPECT_TRUE(warning_of(scene).starts_with("solid.0 is 5.1 times as dense") ||
                    warning_of(scene).starts_with("solid.0 is 2.1 times as dense"));
        scene.solids[0].anchor = SolidAnchor::Ground; // it does not move
        EXPECT_EQ(warning_of(scene), "");
        scene.solids[0].anchor = SolidAnchor::None;
    }
    scene.solids[0].rest_density = 500.0f;
    scene.solids[0].shape = BlockShape{{0.0f, 0.4f, 0.0f}, {1.0f, 0.8f, 1.0f}};
    EXPECT_TRUE(warning_of(scene).starts_with("solid.0 reaches from wall to wall")); // of pbf
    scene.solver = Solver::Dfsph;
    EXPECT_EQ(warning_of(scene), "");
    scene.solids[0].rest_density = 9000.0f;
    scene.solver = Solver::Wcsph;
    EXPECT_EQ(warning_of(scene), "");
}

} // namespace
} // namespace meltpoint
