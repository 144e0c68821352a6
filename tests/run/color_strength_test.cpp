// Solids that are strong where their surface is bright.
#include "run/color_strength.h"

#include <cmath>
#include <fstream>
#include <functional>
#include <map>

#include <gtest/gtest.h>

#include "core/error.h"
#include "run/hydraulic_settings.h"
#include "run/scene_particles.h"
#include "run/scene_warnings.h"
#include "support/mesh_files.h"
#include "support/scratch_folder.h"
#include "support/two_colors.h"

namespace meltpoint {
namespace {

TEST(ColorStrength, IsOfLinearLuminance)
{
    EXPECT_FLOAT_EQ(color_strength({0, 0, 0}, 4.0f), 0.25f);
    EXPECT_FLOAT_EQ(color_strength({255, 255, 255}, 4.0f), 4.0f);
    // sRGB 188 is half of white's light (IEC 61966-2-1); green alone is 0.7152 of it.
    EXPECT_NEAR(color_strength({188, 188, 188}, 4.0f), 1.0f, 0.01f);
    EXPECT_NEAR(color_strength({0, 255, 0}, 4.0f), std::pow(4.0f, 2.0f * 0.7152f - 1.0f), 1e-4f);
}

/// A rock, black and white, beside a block under water.
Scene scene_of(const std::string& mesh)
{
    Scene scene;
    scene.name = "test";
    scene.particles.spacing = 0.05f;
    scene.fluids.push_back({.shape = BlockShape{{-0.5f, 1.0f, -0.5f}, {0.5f, 1.5f, 0.5f}}});
    SolidBody rock;
    rock.shape = MeshShape{.mesh = mesh, .position = {0.0f, 0.25f, 0.0f}};
    rock.erosion = {.erodes = true, .strength_contrast = 3.0f, .strength_from = StrengthSource::Color};
    scene.solids.push_back(rock);
    SolidBody other;
    other.shape = BlockShape{{-0.5f, 0.5f, -0.5f}, {0.5f, 1.0f, 0.5f}};
    other.erosion = {.erodes = true};
    scene.solids.push_back(other);
    return scene;
}

/// Of each particle of the rock: x, and its strength as the simulation gets it.
std::vector<std::pair<float, float>> rock_of(const Scene& scene)
{
    const ParticleSet particles = make_particles(scene, 100'000);
    const auto settings = hydraulic_settings(scene, particles);
    const std::uint32_t rock = scene_materials(scene).of_solid[0];
    std::vector<std::pair<float, float>> found;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (shared::particle_material(particles.attributes[i]) == rock) {
            found.emplace_back(particles.position[i].x, settings->strength[i]);
        } else {
            EXPECT_EQ(settings->strength[i], 1.0f);
        }
    }
    return found;
}

TEST(ColorStrength, OfAScenesSolidsIsThatOfTheirFiles)
{
    const test::ScratchFolder folder;
    TriangleMesh box = test::black_and_white_box({1.0f, 0.5f, 0.8f});
    const std::map<std::string, std::function<std::string()>> files{
        {"rock.ply",
         [&] {
             return test::ascii_ply_of(box);
         }},
        {"rock.obj",
         [&] {
             return test::obj_of(box);
         }},
        {"rock.gltf",
         [&] {
             return test::gltf_of(box);
         }},
        {"rock.glb",
         [&] {
             return test::glb_of(box);
         }},
    };
    for (const auto& [name, content] : files) {
        SCOPED_TRACE(name);
        test::write_bytes(folder / name, content());
        const auto rock = rock_of(scene_of((folder / name).string()));
        ASSERT_EQ(rock.size(), 20u * 10u * 16u);
        for (const auto& [x, strength] : rock) {
            if (std::abs(x) > 0.1f && std::abs(x) < 0.25f) { // deeper inside, the nearest surface may be an end
                EXPECT_FLOAT_EQ(strength, x < 0.0f ? 1.0f / 3.0f : 3.0f);
            }
        }
        EXPECT_TRUE(
            std::ranges::all_of(rock, [](const auto& each) { return each.second >= 0.333f && each.second <= 3.0f; }));
    }

    box.colors.clear();
    for (const auto& [name, content] : files) {
        const std::string file = (folder / name).string();
        test::write_bytes(file, content());
        const Scene scene = scene_of(file);
        const ParticleSet particles = make_particles(scene, 100'000);
        try {
            static_cast<void>(hydraulic_settings(scene, particles));
            ADD_FAILURE();
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::Input);
            EXPECT_EQ(std::string(error.what()), "test: solid.0.strength_from is \"color\", but " + file +
                                                     " has none that are read: those of the vertices of a mesh (.obj, "
                                                     ".ply, .gltf, .glb), or of points (.ply, .xyz)");
        }
    }
}

TEST(ColorStrength, OfAScanIsThatOfItsPoints)
{
    const test::ScratchFolder folder;
    const std::string file = (folder / "scan.xyz").string();
    std::ofstream scan(file);
    for (int i = 0; i < 4000; ++i) { // a ball, black where x < 0 (Fibonacci's spiral)
        const double y = 1.0 - 2.0 * (i + 0.5) / 4000.0;
        const double around = 2.399963 * i;
        const glm::dvec3 n(std::sqrt(1.0 - y * y) * std::cos(around), y, std::sqrt(1.0 - y * y) * std::sin(around));
        const int bright = n.x < 0.0 ? 0 : 255;
        scan << fmt::format("{} {} {} {} {} {} {} {} {}\n", 0.25 * n.x, 0.25 * n.y, 0.25 * n.z, n.x, n.y, n.z, bright,
                            bright, bright);
    }
    scan.close();
    const auto rock = rock_of(scene_of(file));
    ASSERT_GT(rock.size(), 400u);
    for (const auto& [x, strength] : rock) {
        if (std::abs(x) > 0.05f) {
            EXPECT_FLOAT_EQ(strength, x < 0.0f ? 1.0f / 3.0f : 3.0f);
        }
    }
}

TEST(ColorStrength, WithoutContrastIsWarnedOf)
{
    Scene scene = scene_of("rock.ply");
    const auto is_warned = [&] {
        const std::vector<std::string> warnings = scene_warnings(scene, {});
        return std::ranges::any_of(
            warnings, [](const std::string& each) { return each.find("strength_from") != std::string::npos; });
    };
    EXPECT_FALSE(is_warned());
    scene.solids[0].erosion.strength_contrast = 1.0f;
    EXPECT_TRUE(is_warned());
}

} // namespace
} // namespace meltpoint
