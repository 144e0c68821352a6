#include "run/mesh_scene.h"

#include <cmath>

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "run/scene_particles.h"
#include "scene/scene_file.h"
#include "support/clouds.h"
#include "support/scratch_folder.h"

namespace meltpoint {
namespace {

/// A cube of the given edge, in meters.
std::string cube_obj(const std::string& edge)
{
    std::string text;
    for (const char* corner : {"0 0 0", "E 0 0", "E E 0", "0 E 0", "0 0 E", "E 0 E", "E E E", "0 E E"}) {
        text += "v ";
        for (const char c : std::string(corner)) {
            text += c == 'E' ? edge : std::string(1, c);
        }
        text += "\n";
    }
    return text + "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 1 5 8 4\n";
}

std::string refusal(const std::string& name, const std::vector<std::string>& overrides = {})
{
    try {
        static_cast<void>(find_scene(name, overrides));
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        return error.what();
    }
    return "";
}

TEST(FindScene, KnowsTheBuiltInScenes)
{
    for (const std::string& name : builtin_scene_names()) {
        EXPECT_EQ(find_scene(name, {}).name, name);
    }
}

TEST(FindScene, SuggestsTheNearestName)
{
    const std::string all = fmt::format("{}", fmt::join(builtin_scene_names(), ", "));
    const std::string misspelled = refusal("teapot_dorp");
    EXPECT_TRUE(
        misspelled.starts_with("there is no scene or mesh \"teapot_dorp\": neither a file nor a built-in scene ("))
        << misspelled;
    EXPECT_TRUE(misspelled.ends_with(all + "); did you mean \"teapot_drop\"?")) << misspelled;
    EXPECT_TRUE(refusal("teapot").ends_with("; did you mean \"builtin:teapot\"?")) << refusal("teapot");
    EXPECT_TRUE(refusal("").ends_with(all + ")")) << refusal("");
}

TEST(FindScene, ATooLongNameIsBadInput)
{
    EXPECT_TRUE(refusal(std::string(5000, 'x')).starts_with("there is no scene or mesh"));
}

TEST(FindScene, ABuiltInSceneIsNotHiddenByAFolderOfItsName)
{
    const test::ScratchFolder folder;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    std::filesystem::create_directory("drop");
    EXPECT_EQ(find_scene("drop", {}).name, "drop");
    EXPECT_EQ(refusal("./drop"), "./drop: cannot read the scene: it is a folder");
    std::filesystem::current_path(before);
}

TEST(FindScene, ReadsSceneFilesWithMeshesBesideThem)
{
    const test::ScratchFolder folder;
    test::write_bytes(folder / "cube.obj", cube_obj("0.5"));
    test::write_bytes(folder / "my scene.toml",
                      "name = \"mine\"\n[[fluid]]\nshape = \"mesh\"\nmesh = \"cube.obj\"\nposition = [0, 1, 0]\n");
    const Scene scene = find_scene((folder / "my scene.toml").string(), {});
    EXPECT_EQ(scene.name, "mine");
    EXPECT_EQ(std::get<MeshShape>(scene.fluids.at(0).shape).mesh, (folder / "cube.obj").string());
    EXPECT_EQ(refusal((folder / "other.toml").string()),
              (folder / "other.toml").string() + ": cannot read the scene: No such file or directory");
}

TEST(FindScene, AppliesOverridesToEveryKindOfScene)
{
    const test::ScratchFolder folder;
    test::write_bytes(folder / "cube.obj", cube_obj("0.5"));
    test::write_bytes(folder / "s.toml", "[[fluid]]\nshape = \"block\"\nmin = [0, 0, 0]\nmax = [0.5, 0.5, 0.5]\n");
    const std::vector<std::string> overrides{"physics.viscosity=0.125", "fluid.0.velocity=[0, 1, 0]"};
    for (const std::string& name : {std::string("drop"), std::string("builtin:torus"), (folder / "cube.obj").string(),
                                    (folder / "s.toml").string()}) {
        const Scene scene = find_scene(name, overrides);
        EXPECT_EQ(scene.physics.viscosity, 0.125f) << name;
        EXPECT_EQ(scene.fluids.at(0).velocity, glm::vec3(0.0f, 1.0f, 0.0f)) << name;
        EXPECT_NE(refusal(name, {"physics.viscosty=1"}).find("did you mean \"physics.viscosity\"?"), std::string::npos);
    }
}

TEST(MeshScene, HoldsAboutSixteenThousandParticlesInABoxThatFits)
{
    for (const char* name : {"builtin:teapot", "builtin:cube"}) {
        const Scene scene = find_scene(name, {});
        EXPECT_EQ(scene.name, std::string(name).substr(8));
        const ParticleSet particles = make_particles(scene, 1'000'000); // throws where fluid lies outside
        EXPECT_GT(particles.size(), 15'000u) << name;
        EXPECT_LT(particles.size(), 17'000u) << name;
        float lowest = 1e9f;
        float highest = -1e9f;
        for (const glm::vec3& x : particles.position) {
            lowest = std::min(lowest, x.y);
            highest = std::max(highest, x.y);
        }
        EXPECT_GT(lowest, 0.3f) << "it falls";
        EXPECT_LT(highest, scene.domain.max.y) << "and may splash";
    }
}

TEST(MeshScene, AScanIsDroppedAsItsMeshIs)
{
    const test::ScratchFolder folder;
    test::write_bytes(folder / "ring.xyz", test::xyz_of(test::points_on("torus", 6000, SurfaceMethod::BlueNoise)));
    test::write_bytes(folder / "flat.xyz", "0 0 0\n1 0 0\n1 0 1\n0 0 1\n0.5 0 0.5\n");
    const Scene scan = find_scene((folder / "ring.xyz").string(), {});
    const Scene mesh = find_scene("builtin:torus", {});
    EXPECT_EQ(scan.name, "ring");
    EXPECT_EQ(scan.description, "A scan filled with fluid, dropped into a box.");
    EXPECT_NEAR(scan.particles.spacing / mesh.particles.spacing, 1.0f, 0.01f);
    EXPECT_NEAR(scan.domain.max.y / mesh.domain.max.y, 1.0f, 0.02f);
    const auto count = static_cast<double>(make_particles(scan, 1'000'000).size()); // throws where fluid lies outside
    EXPECT_NEAR(count, 16'000.0, 1200.0);
    EXPECT_EQ(refusal((folder / "flat.xyz").string()),
              (folder / "flat.xyz").string() +
                  ": the scan encloses no volume that could be filled: it is flat, or its normals face inward");
}

TEST(MeshScene, IsTheSameAtEverySizeButForItsScale)
{
    const test::ScratchFolder folder;
    test::write_bytes(folder / "small.obj", cube_obj("0.09"));
    test::write_bytes(folder / "large.obj", cube_obj("9"));
    const Scene small = mesh_scene((folder / "small.obj").string());
    const Scene large = mesh_scene((folder / "large.obj").string());
    const auto close = [](float a, float b) {
        return std::abs(a / b - 1.0f) < 1e-3f;
    };
    EXPECT_TRUE(close(large.particles.spacing, 100.0f * small.particles.spacing));
    EXPECT_TRUE(close(large.domain.max.y, 100.0f * small.domain.max.y));
    EXPECT_TRUE(close(large.time.frame_rate, 0.1f * small.time.frame_rate)) << "Froude: time goes as its square root";
    EXPECT_TRUE(close(large.physics.viscosity, 1000.0f * small.physics.viscosity));
}

TEST(MeshScene, NamesMeshesThatItCannotDrop)
{
    const test::ScratchFolder folder;
    test::write_bytes(folder / "flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    test::write_bytes(folder / "tiny.obj", cube_obj("1e-6"));
    test::write_bytes(folder / "huge.obj", cube_obj("1e6"));
    test::write_bytes(folder / "empty.obj", "");
    test::write_bytes(folder / "nan.obj", cube_obj("nan"));
    const auto message = [&](const char* file) {
        return refusal((folder / file).string());
    };
    EXPECT_EQ(message("flat.obj"),
              (folder / "flat.obj").string() + ": the mesh encloses no volume that could be filled");
    EXPECT_NE(message("tiny.obj").find("tiny.obj: the mesh is 1e-06 m large"), std::string::npos)
        << message("tiny.obj");
    EXPECT_NE(message("huge.obj").find("huge.obj: the mesh is 1e+06 m large"), std::string::npos)
        << message("huge.obj");
    EXPECT_NE(message("empty.obj").find("the file is empty"), std::string::npos) << message("empty.obj");
    EXPECT_NE(message("nan.obj").find("not finite"), std::string::npos) << message("nan.obj");
    EXPECT_NE(refusal("builtin:tours").find("did you mean \"torus\"?"), std::string::npos) << refusal("builtin:tours");
}

TEST(MeshScene, LargestAndSmallestMeshesMakeValidScenes)
{
    const test::ScratchFolder folder;
    for (const char* edge : {"0.001", "1000", "2000"}) {
        test::write_bytes(folder / "cube.obj", cube_obj(edge));
        for (const LookName& look : look_names()) {
            EXPECT_NO_THROW(static_cast<void>(find_scene((folder / "cube.obj").string(), {}, look.look)))
                << edge << ", " << look.name;
        }
    }
}

TEST(MeshScene, SolidsOfLooksStandOnTheFloor)
{
    for (const Look look : {Look::Melt, Look::Dune, Look::Vanish, Look::Wash}) {
        const Scene scene = find_scene("builtin:torus", std::vector<std::string>{"particles.spacing=0.1"}, look);
        ASSERT_EQ(scene.solids.size(), 1u);
        EXPECT_EQ(scene.solids[0].melts, look == Look::Melt);
        EXPECT_EQ(scene.solids[0].wind_erodes, look == Look::Dune);
        EXPECT_EQ(scene.solids[0].erosion.erodes, look == Look::Wash);
        EXPECT_EQ(scene.solids[0].becomes == SolidBecomes::Dust, look == Look::Vanish);
        const ParticleSet set = make_particles(scene, 1'000'000);
        float lowest = 1e9f;
        for (const glm::vec3& x : set.position) {
            lowest = std::min(lowest, x.y);
        }
        EXPECT_GT(lowest, 0.0f);
        EXPECT_LT(lowest, 1.5f * scene.particles.spacing);
    }
    EXPECT_THROW(static_cast<void>(find_scene("drop", {}, Look::Melt)), Error);
}

TEST(MeshScene, IceOfEverySizeIsGoneInAsManyFrames)
{
    const test::ScratchFolder folder;
    test::write_bytes(folder / "small.obj", cube_obj("0.09"));
    test::write_bytes(folder / "large.obj", cube_obj("9"));
    const Scene small = mesh_scene((folder / "small.obj").string(), Look::Melt);
    const Scene large = mesh_scene((folder / "large.obj").string(), Look::Melt);
    const float heat_per_frame = large.heat.time_scale / large.time.frame_rate;
    EXPECT_NEAR(heat_per_frame / (small.heat.time_scale / small.time.frame_rate), 100.0f, 1e-2f);
}

} // namespace
} // namespace meltpoint
