#include "scene/scene_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "scene/key_table.h"
#include "scene/liquids.h"
#include "scene/scene_check.h"
#include "scene/scene_reference.h"
#include "support/scratch_folder.h"

namespace meltpoint {
namespace {

constexpr const char* BLOCK = R"(
[[fluid]]
shape = "block"
min = [0, 0, 0]
max = [0.5, 0.5, 0.5]
)";

Scene parse(const std::string& text, const std::vector<std::string>& overrides = {})
{
    return parse_scene(text, "test.toml", "/scenes", overrides);
}

/// The sentence with which an action fails; fails the test when it does not fail, or not as bad input.
template <class Action>
std::string complaint_of(const Action& action)
{
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        return error.what();
    }
    ADD_FAILURE() << "no error";
    return {};
}

std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {})
{
    return complaint_of([&] { parse(text, overrides); });
}

std::string error_with_block(const std::string& text, const std::vector<std::string>& overrides = {})
{
    return error_of(text + BLOCK, overrides);
}

std::string block_with(const std::string& overridden)
{
    return error_of(BLOCK, {overridden});
}

TEST(SceneFile, LeavesOutWhatIsNotSet)
{
    const Scene scene = parse(BLOCK);
    EXPECT_EQ(scene.name, "untitled");
    EXPECT_EQ(scene.physics.gravity, glm::vec3(0.0f, -9.81f, 0.0f));
    EXPECT_FALSE(scene.time.dt.has_value());
    ASSERT_EQ(scene.fluids.size(), 1u);
    EXPECT_EQ(std::get<BlockShape>(scene.fluids[0].shape).max, glm::vec3(0.5f));
}

TEST(SceneFile, ReadsEveryType)
{
    const Scene scene = parse(R"(
        name = "a \"name\" with ü"
        kernel = "wendland"
        seed = 1000000000000000000
        [physics]
        gravity = [0, -1, 0.5]
        viscosity = 1      # a whole number where a number is due
        clamp_pressure = false
        speed_of_sound = 20.5
        [time]
        dt = "auto"
        frames = 7
        [render]
        color_range = [0, 2.5]
        [[fluid]]
        shape = "sphere"
        center = [0, 1, 0]
        radius = 0.25
        velocity_gradient = [[1, 2, 3], [4, 5, 6], [7, 8, 9]]
        [[fluid]]
        shape = "mesh"
        mesh = "meshes/../cup.obj"
        position = [0, 0.5, 0]
        [[fluid]]
        shape = "mesh"
        mesh = "builtin:teapot"
        position = [0, 0.5, 0]
        size = 0.5
    )");
    EXPECT_EQ(scene.name, "a \"name\" with ü");
    EXPECT_EQ(scene.kernel, SphKernel::Wendland);
    EXPECT_EQ(scene.seed, 1000000000000000000u);
    EXPECT_EQ(scene.physics.gravity, glm::vec3(0.0f, -1.0f, 0.5f));
    EXPECT_EQ(scene.physics.viscosity, 1.0f);
    EXPECT_FALSE(scene.physics.clamp_pressure);
    EXPECT_EQ(scene.physics.speed_of_sound, 20.5f);
    EXPECT_FALSE(scene.time.dt.has_value());
    EXPECT_EQ(scene.time.frames, 7u);
    EXPECT_EQ(scene.render.color_range, glm::vec2(0.0f, 2.5f));
    ASSERT_EQ(scene.fluids.size(), 3u);
    // Row 1 of the file times (1, 0, 0), (0, 1, 0), ...: the matrix acts on positions as it is written.
    EXPECT_EQ(scene.fluids[0].velocity_gradient * glm::vec3(1.0f, 10.0f, 100.0f), glm::vec3(321.0f, 654.0f, 987.0f));
    EXPECT_EQ(std::get<MeshShape>(scene.fluids[1].shape).mesh, "/scenes/cup.obj");
    EXPECT_FALSE(std::get<MeshShape>(scene.fluids[1].shape).size.has_value());
    EXPECT_EQ(std::get<MeshShape>(scene.fluids[2].shape).mesh, "builtin:teapot");
}

TEST(SceneFile, NamesUnknownKeys)
{
    EXPECT_EQ(error_with_block("[physics]\nviscosty = 1"),
              "test.toml:2: key \"physics.viscosty\" is unknown; did you mean \"physics.viscosity\"?");
    EXPECT_EQ(error_with_block("viscosity = 1"),
              "test.toml:1: key \"viscosity\" is unknown; did you mean \"physics.viscosity\"?");
    EXPECT_EQ(error_with_block("[phisics]"), "test.toml:1: key \"phisics\" is unknown; did you mean \"physics\"?");
    EXPECT_EQ(error_with_block("[time]\nwarp = 1"),
              "test.toml:2: key \"time.warp\" is unknown; \"time\" has the keys dt, frame_rate, frames");
    EXPECT_EQ(
        error_with_block("\"physics.viscosity\" = 1").find("test.toml:1: key \"\"physics.viscosity\"\" is unknown"),
        0u);
    EXPECT_EQ(error_of(std::string(BLOCK) + "radios = 1"),
              "test.toml:6: key \"fluid.0.radios\" is unknown; did you mean \"fluid.0.radius\"?");
    EXPECT_EQ(error_of(std::string(BLOCK) + "tension = 1"),
              "test.toml:6: key \"fluid.0.tension\" is unknown; did you mean \"fluid.0.surface_tension\"?");
}

TEST(SceneFile, NamesWrongTypes)
{
    EXPECT_EQ(error_with_block("[physics]\nviscosity = \"thick\""),
              "test.toml:2: key \"physics.viscosity\" is \"thick\", but must be a number from 0 to 10000 Pa s");
    EXPECT_EQ(error_with_block("[physics]\ngravity = [0, -9.81]"),
              "test.toml:2: key \"physics.gravity\" is [0, -9.81], "
              "but must be [x, y, z], each from -10000 to 10000 m/s^2");
    EXPECT_EQ(error_with_block("[time]\nframes = 2.0"),
              "test.toml:2: key \"time.frames\" is 2.0, but must be a whole number from 1 to 1000000");
    EXPECT_EQ(error_with_block("[domain]\nwalls = 1"),
              "test.toml:2: key \"domain.walls\" is 1, but must be true or false");
    EXPECT_EQ(error_with_block("name = 2024-01-01"),
              "test.toml:1: key \"name\" is a date or time, but must be a string of 1 to 200 bytes of UTF-8");
    EXPECT_EQ(error_with_block("kernel = \"wendlnd\""),
              "test.toml:1: key \"kernel\" is \"wendlnd\", but must be \"paper\" "
              "or \"wendland\"; did you mean \"wendland\"?");
    EXPECT_EQ(error_with_block("[time]\ndt = \"soon\""),
              "test.toml:2: key \"time.dt\" is \"soon\", but must be a number from 1e-09 to 1 s or \"auto\"");
    EXPECT_EQ(error_with_block("[particles]\nspacing = \"auto\""),
              "test.toml:2: key \"particles.spacing\" is \"auto\", but must be a number from 1e-05 to 100 m");
    EXPECT_EQ(error_with_block("physics = 3"), "test.toml:1: key \"physics\" must be one table: [physics]");
    EXPECT_EQ(error_with_block("[[physics]]"), "test.toml:1: key \"physics\" must be one table: [physics]");
    EXPECT_EQ(error_with_block("[seed]"), "test.toml:1: key \"seed\" is a table, but must be a whole number from 0 to "
                                          "1e+18");
    EXPECT_EQ(error_of("[fluid]"),
              "test.toml:1: key \"fluid\" must be an array of tables: [[fluid]], once for each fluid");
    EXPECT_EQ(error_of("fluid = 3"),
              "test.toml:1: key \"fluid\" must be an array of tables: [[fluid]], once for each fluid");
}

TEST(SceneFile, NamesValuesOutOfRange)
{
    EXPECT_EQ(error_with_block("[physics]\nviscosity = -1"),
              "test.toml:2: key \"physics.viscosity\" is -1, but must be a number from 0 to 10000 Pa s");
    EXPECT_NE(error_with_block("[physics]\nviscosity = nan").find("is nan, but must be"), std::string::npos);
    EXPECT_NE(error_with_block("[physics]\ngravity = [0, -inf, 0]").find("is [0, -inf, 0], but must be"),
              std::string::npos);
    EXPECT_NE(error_with_block("[physics]\nviscosity = 1e300").find("is 1e+300, but must be"), std::string::npos);
    EXPECT_NE(error_with_block("[particles]\nspacing = 1e-60").find("is 1e-60, but must be"), std::string::npos);
    EXPECT_NE(error_with_block("seed = -1").find("is -1, but must be a whole number"), std::string::npos);
    EXPECT_NE(error_with_block("name = \"\"").find("is \"\", but must be"), std::string::npos);
    EXPECT_NE(error_with_block("name = \"\\u0000\"").find("key \"name\""), std::string::npos);
    EXPECT_NE(error_with_block("name = \"" + std::string(300, 'x') + "\"").find("is 302 bytes long"),
              std::string::npos);
}

TEST(SceneFile, NamesContradictions)
{
    EXPECT_EQ(error_with_block("[domain]\nmin = [0, 0, 0]\nmax = [1, 0, 1]"),
              "test.toml:3: key \"domain.max\" is [1, 0, 1], but must be above domain.min = [0, 0, 0] in x, y and z");
    EXPECT_EQ(error_with_block("[particles]\nspacing = 2.5"),
              "test.toml:2: key \"particles.spacing\" is 2.5 m, but must be at most the domain's smallest extent, 2 m");
    EXPECT_EQ(error_with_block("[camera]\nup = [0, 0, 0]"),
              "test.toml:2: key \"camera.up\" is [0, 0, 0], but must have a direction");
    EXPECT_EQ(error_of("[render]\nlight = [0, 0, 0]"),
              "test.toml:2: key \"render.light\" is [0, 0, 0], but must have a direction");
    for (const char* gravity : {"[0, 9.81, 0]", "[-9.81, -1, 0]", "[0, -1, 0.1]"}) { // not down
        EXPECT_NE(error_of(std::string("solver = \"dfsph\"\n[physics]\ngravity = ") + gravity +
                           "\n[[solid]]\nshape = \"block\"\nmin = [0.2, 0.2, 0.2]\nmax = [0.6, 0.6, 0.6]\n"
                           "wind_erodes = true\n")
                      .find("but sand (wind_erodes) comes down along y: it must be [0, -g, 0]"),
                  std::string::npos)
            << gravity;
    }
    EXPECT_EQ(error_with_block("[camera]\neye = [1, 2, 3]\ntarget = [1, 2, 3]"),
              "test.toml:3: key \"camera.target\" is [1, 2, 3], but must differ from camera.eye");
    EXPECT_NE(error_with_block("[camera]\neye = [0, 5, 0]\ntarget = [0, 0, 0]").find("must not be parallel"),
              std::string::npos);
    EXPECT_EQ(error_with_block("[render]\ncolor_range = [2, 2]"),
              "test.toml:2: key \"render.color_range\" is [2, 2], but its first number must be below its second");
    EXPECT_EQ(error_with_block("[time]\nframe_rate = 100\ndt = 0.02"),
              "test.toml:3: key \"time.dt\" is 0.02 s, but must be at most the time between two frames, 1/100 s");
    EXPECT_EQ(error_of(""),
              "test.toml: key \"fluid\" is missing: a scene has at least one [[fluid]], [[solid]], [[emitter]] or "
              "[[surface]]");
}

TEST(SceneFile, TwoDimensionsMeanNothingByZ)
{
    const Scene scene =
        parse("[domain]\ndimensions = 2\nmin = [0, 0, 0]\nmax = [4, 2, 0]\n[[fluid]]\nshape = \"block\"\n"
              "min = [0, 0, 7]\nmax = [1, 1, 7]\n[[collider]]\nshape = \"block\"\nmin = [2, 0, 0]\n"
              "max = [2, 1, 0]\n[[collider]]\nshape = \"sphere\"\ncenter = [3, 1, 9]\nradius = 0.2");
    EXPECT_EQ(scene.domain.dimensions, 2u);
    const std::string flat = "[domain]\ndimensions = 2\n";
    const auto error_in_plane = [&](const std::string& text) {
        std::string found = error_with_block(flat + text);
        EXPECT_NE(found.find("where domain.dimensions is 2"), std::string::npos) << found;
        return found;
    };
    EXPECT_EQ(error_in_plane("[physics]\ngravity = [0, -9, 1]"),
              "test.toml:4: key \"physics.gravity\" is [0, -9, 1], but must have no z where domain.dimensions is 2");
    error_in_plane("periodic = [false, false, true]");
    error_in_plane("lid_velocity = [0, 0, 1]");
    error_in_plane("[[surface]]\nshape = \"sphere\"\ncenter = [0, 1, 0]\nradius = 0.5");
    error_in_plane("[[collider]]\nshape = \"mesh\"\nmesh = \"builtin:cube\"\nposition = [0, 1, 0]");
    const auto error_of_fluid = [&](const std::string& text) {
        return error_in_plane("[[fluid]]\nshape = \"sphere\"\ncenter = [0, 1, 0]\nradius = 0.2\n" + text);
    };
    error_of_fluid("lattice = \"blue-noise\"");
    error_in_plane("[[solid]]\nshape = \"sphere\"\ncenter = [0, 1, 0]\nradius = 0.2\nlattice = \"blue-noise\"");
    error_of_fluid("velocity = [0, 0, 1]");
    error_of_fluid("velocity_gradient = [[0, 0, 0], [0, 0, 0], [1, 0, 0]]");
    error_of_fluid("spin = [0, 1, 0]");
    EXPECT_NE(error_with_block(flat + "max = [1, 0, 1]").find("in x and y"), std::string::npos);
    EXPECT_NE(error_with_block("[domain]\ndimensions = 4").find("a whole number from 2 to 3"), std::string::npos);
}

TEST(SceneFile, PeriodicAxesAndLids)
{
    const Scene scene =
        parse("[domain]\nperiodic = [true, false, true]\nlid_velocity = [1, 0, 0]\n" + std::string(BLOCK));
    EXPECT_EQ(scene.domain.periodic, glm::bvec3(true, false, true));
    EXPECT_EQ(scene.domain.lid_velocity, glm::vec3(1.0f, 0.0f, 0.0f));
    EXPECT_EQ(error_with_block("[domain]\nperiodic = [true, 1, false]"),
              "test.toml:2: key \"domain.periodic\" is [true, 1, false], but must be [x, y, z], each true or false");
    EXPECT_EQ(
        error_with_block("[particles]\nspacing = 0.6\n[domain]\nperiodic = [true, false, false]"),
        "test.toml:4: key \"domain.periodic\" makes a domain that is 2 m wide along x, periodic, where it must be "
        "at least two support radii, 2.4 m (2 x particles.support_ratio x particles.spacing)");
    EXPECT_EQ(
        error_with_block("[domain]\nmin = [0, 0, 0]\nmax = [2, 2, 0.07]"),
        "test.toml:3: key \"domain.max\" makes a domain that is 0.07 m wide along z, between walls, where it must "
        "be at least two support radii, 0.08 m (2 x particles.support_ratio x particles.spacing)");
    EXPECT_NE(error_with_block("[domain]\nlid_velocity = [0, 1, 0]").find("along itself"), std::string::npos);
    EXPECT_NE(error_with_block("[domain]\nperiodic = [false, true, false]\nlid_velocity = [1, 0, 0]")
                  .find("no wall at the top"),
              std::string::npos);
    EXPECT_NE(error_with_block("[domain]\nwalls = false\nlid_velocity = [1, 0, 0]").find("no wall at the top"),
              std::string::npos);
    EXPECT_NE(error_with_block("solver = \"pbf\"\n[physics]\nshifting = 1").find("moves particles itself"),
              std::string::npos);
    for (const char* body : {"fluid", "solid"}) {
        EXPECT_NE(error_of(fmt::format("[domain]\nperiodic = [true, false, false]\n[[{}]]\nshape = \"block\"\n"
                                       "min = [0, 0, 0]\nmax = [1, 1, 1]\nlattice = \"blue-noise\"",
                                       body))
                      .find("knows no domain.periodic"),
                  std::string::npos);
    }
}

TEST(SceneFile, NamesMistakesOfShapes)
{
    EXPECT_EQ(error_of("[[fluid]]\ncolor = [1, 0, 0]"),
              "test.toml:1: key \"fluid.0\" has no \"shape\", which must be \"block\", \"sphere\" or \"mesh\"");
    EXPECT_EQ(
        error_of("[[fluid]]\nshape = \"sphere\"\nradius = 0.5"),
        "test.toml:1: key \"fluid.0\" is a sphere without \"center\", which must be [x, y, z], each from -10000 to "
        "10000 m");
    EXPECT_EQ(error_of(std::string(BLOCK) + "radius = 0.5"),
              "test.toml:6: key \"fluid.0.radius\" belongs to shape = \"sphere\", but this fluid has shape = \"block\" "
              "with the keys min, max");
    EXPECT_EQ(
        block_with("fluid.0.shape=ball"),
        "override \"fluid.0.shape=ball\": key \"fluid.0.shape\" is \"ball\", but must be \"block\", \"sphere\" or "
        "\"mesh\"");
    EXPECT_NE(block_with("fluid.0.max=[0.5,-1,0.5]").find("must be above fluid.0.min"), std::string::npos);
    EXPECT_NE(block_with("fluid.0.max=[0.5,0.01,0.5]").find("0.01 m thin, but it must be at least"), std::string::npos);
    EXPECT_EQ(
        block_with("fluid.0.min=[0,-0.5,0]"),
        "override \"fluid.0.min=[0,-0.5,0]\": key \"fluid.0.min\" puts the body in [0, -0.5, 0] to [0.5, 0.5, 0.5], "
        "but it must lie inside the domain, [-1, 0, -1] to [1, 2, 1]");
    EXPECT_NE(error_of("[[fluid]]\nshape='sphere'\ncenter=[0,0.2,0]\nradius=0.21")
                  .find("test.toml:3: key \"fluid.0.center\""),
              std::string::npos);
    EXPECT_NO_THROW(parse("[[fluid]]\nshape='sphere'\ncenter=[0,0.3,0]\nradius=0.3"));
}

constexpr const char* COLLIDER = "[[collider]]\nshape='block'\nmin=[-1,0.1,-1]\nmax=[1,0.2,1]\n";

TEST(SceneFile, HasColliders)
{
    const Scene scene = parse(std::string(BLOCK) + COLLIDER + "friction = 2.5\nsolid = false\nspacing = 0.5\n" +
                              "[[collider]]\nshape='mesh'\nmesh='cup.obj'\nposition=[0,1,0]\ncolor=[1,0,0]\n");
    ASSERT_EQ(scene.colliders.size(), 2u);
    EXPECT_EQ(std::get<BlockShape>(scene.colliders[0].shape).max, glm::vec3(1.0f, 0.2f, 1.0f));
    EXPECT_EQ(scene.colliders[0].friction, 2.5f);
    EXPECT_FALSE(scene.colliders[0].solid);
    EXPECT_EQ(scene.colliders[0].spacing, 0.5f);
    EXPECT_EQ(std::get<MeshShape>(scene.colliders[1].shape).mesh, "/scenes/cup.obj");
    EXPECT_TRUE(scene.colliders[1].solid);
    EXPECT_EQ(scene.colliders[1].color, glm::vec3(1.0f, 0.0f, 0.0f));
    EXPECT_TRUE(parse(BLOCK).colliders.empty());
    EXPECT_TRUE(parse(std::string(BLOCK) + COLLIDER, {"collider=[]"}).colliders.empty());
}

TEST(SceneFile, CollidersMistakesAreNamed)
{
    const auto collider_with = [](const std::string& override_text) {
        return error_of(std::string(BLOCK) + COLLIDER, {override_text});
    };
    EXPECT_NE(collider_with("collider.0.frction=1").find("did you mean \"collider.0.friction\"?"), std::string::npos);
    EXPECT_NE(collider_with("collider.0.spacing=1.1").find("must be a number from 0.25 to 0.75 particle spacings"),
              std::string::npos);
    EXPECT_NE(collider_with("collider.0.friction=-1").find("must be a number from 0 to 10000 Pa s"), std::string::npos);
    EXPECT_NE(collider_with("collider.1.friction=1").find("the scene has 1 collider, counted from 0"),
              std::string::npos);
    EXPECT_NE(
        collider_with("collider.0.radius=1").find("but this collider has shape = \"block\" with the keys min, max"),
        std::string::npos);
    EXPECT_NE(collider_with("collider.0.max=[1,0.05,1]").find("(equal in one of them: a plate)"), std::string::npos);
    EXPECT_NE(collider_with("collider.0.max=[-1,0.1,1]").find("(equal in one of them: a plate)"), std::string::npos);
    EXPECT_NO_THROW(parse(std::string(BLOCK) + COLLIDER, {"collider.0.max=[1,0.1,1]"}));
    EXPECT_NE(error_of(std::string(BLOCK) + "[collider]").find("must be an array of tables: [[collider]]"),
              std::string::npos);
    EXPECT_NE(error_of(std::string(BLOCK) + "[[collider]]").find("key \"collider.0\" has no \"shape\""),
              std::string::npos);

    std::string text(BLOCK);
    for (int i = 0; i < 64; ++i) {
        text += fmt::format("{}friction = {}\n", COLLIDER, i);
    }
    EXPECT_NE(error_of(text).find("key \"collider.63\" makes 65 different materials"), std::string::npos);
}

TEST(SceneFile, LimitsDistinctFluids)
{
    std::string text;
    for (int i = 0; i < 65; ++i) {
        text += fmt::format("{}rest_density = {}\n", BLOCK, 1000 + i);
    }
    EXPECT_EQ(
        error_of(text),
        "test.toml:386: key \"fluid.64\" makes 65 different materials (fluids by rest density and color, colliders by "
        "friction and color, solids by both), but a "
        "scene has at most 64");
    EXPECT_NO_THROW(parse(text, {"fluid.64.rest_density=1000"}));

    std::string many;
    for (int i = 0; i < 1025; ++i) {
        many += BLOCK;
    }
    EXPECT_NE(error_of(many).find("at most 1024 fluids"), std::string::npos);
}

TEST(SceneFile, PassesOnSyntaxErrors)
{
    EXPECT_EQ(error_of("a = 1\nb = \n").find("test.toml:2:5: "), 0u);
    EXPECT_EQ(error_of("[physics]\nviscosity = 1\nviscosity = 2").find("test.toml:3:"), 0u);
    EXPECT_EQ(error_of("name = \"\xff\"").find("test.toml:1:"), 0u); // not UTF-8
    EXPECT_EQ(error_of(std::string("\0\0\0", 3)).find("test.toml:1:"), 0u);
}

TEST(SceneFile, RefusesToNestWithoutEnd)
{
    std::string key = "a";
    for (int i = 0; i < 200000; ++i) {
        key += ".a";
    }
    EXPECT_NE(error_of("\n" + key + " = 1").find("test.toml:2: more than 64 dots"), std::string::npos);
    EXPECT_NE(error_of("a = " + std::string(100000, '[')).find("test.toml:1:"), std::string::npos);

    // As deep as tables go within the limits of both the parser and the line.
    std::string nested = "1";
    for (int i = 0; i < 120; ++i) {
        nested = fmt::format("{{ {} = [\n{}\n] }}", key.substr(0, 127), nested);
    }
    EXPECT_NE(error_of("physics.gravity = " + nested).find("test.toml:1: key \"physics.gravity\" is a table"),
              std::string::npos);
    // Rows of dots are comments, not keys.
    EXPECT_NO_THROW(parse("# " + std::string(500, '.') + "\n" + BLOCK));
}

TEST(SceneFile, AppliesOverridesInOrder)
{
    const Scene scene = parse(std::string("[physics]\nviscosity = 3\n") + BLOCK,
                              {"physics.viscosity=0.1", "kernel=wendland", " time.frames = 10 ", "domain.max=[1,2.5,1]",
                               "fluid.0.velocity=[0,1,0]", "name=\"x=y\"", "time.frames=11", "time.dt=auto",
                               "particles={spacing=0.01,support_ratio=3}", "description=two words"});
    EXPECT_EQ(scene.physics.viscosity, 0.1f);
    EXPECT_EQ(scene.kernel, SphKernel::Wendland);
    EXPECT_EQ(scene.time.frames, 11u);
    EXPECT_EQ(scene.domain.max, glm::vec3(1.0f, 2.5f, 1.0f));
    EXPECT_EQ(scene.fluids[0].velocity, glm::vec3(0.0f, 1.0f, 0.0f));
    EXPECT_EQ(scene.name, "x=y");
    EXPECT_EQ(scene.particles.support_ratio, 3.0f);
    EXPECT_EQ(scene.description, "two words");
}

TEST(SceneFile, OverridesReplaceFluids)
{
    const Scene scene =
        parse(BLOCK, {"fluid=[{shape='sphere',center=[0,1,0],radius=0.5},{shape='block',min=[0,0,0],max=[1,0.2,1]}]",
                      "fluid.1.rest_density=500"});
    ASSERT_EQ(scene.fluids.size(), 2u);
    EXPECT_EQ(shape_name(scene.fluids[0].shape), "sphere");
    EXPECT_EQ(scene.fluids[1].rest_density, 500.0f);
    EXPECT_EQ(
        parse(BLOCK, {"fluid.0={shape='mesh',mesh='/a/b.obj',position=[0,1,0]}", "fluid.0.size=0.5"}).fluids.size(),
        1u);
}

TEST(SceneFile, NamesBadOverrides)
{
    EXPECT_EQ(block_with("physics.viscosty=1"),
              "override \"physics.viscosty=1\": key \"physics.viscosty\" is unknown; did "
              "you mean \"physics.viscosity\"?");
    EXPECT_EQ(block_with("physics.viscosity=-1"),
              "override \"physics.viscosity=-1\": key \"physics.viscosity\" is -1, but "
              "must be a number from 0 to 10000 Pa s");
    EXPECT_EQ(block_with("fluid.3.velocity=[0,0,0]"),
              "override \"fluid.3.velocity=[0,0,0]\": key \"fluid.3.velocity\" is "
              "unknown; the scene has 1 fluid, counted from 0");
    EXPECT_NE(block_with("fluid.00.velocity=[0,0,0]").find("is unknown"), std::string::npos);
    EXPECT_NE(block_with("fluid.99999999999999999999.velocity=[0,0,0]").find("is unknown"), std::string::npos);
    EXPECT_EQ(block_with("nonsense"),
              "override \"nonsense\" is not of the form key=value, as in physics.viscosity=0.1");
    EXPECT_EQ(block_with("=1"), "override \"=1\" is not of the form key=value, as in physics.viscosity=0.1");
    EXPECT_EQ(block_with("name="), "override \"name=\" has no value after \"=\"");
    EXPECT_EQ(block_with("name=1\nseed=2"), "override \"name=1\\nseed=2\" has a line break");
    EXPECT_EQ(block_with("domain.max=[1,2").find("override \"domain.max=[1,2\""), 0u);
    EXPECT_EQ(block_with("a.b.c=1"), "override \"a.b.c=1\": key \"a.b.c\" is unknown; there is no table \"a.b\"");
    EXPECT_EQ(block_with("fluid=[]"), "override \"fluid=[]\": key \"fluid\" is missing: a scene has at least one "
                                      "[[fluid]], [[solid]], [[emitter]] or [[surface]]");
    EXPECT_EQ(block_with("fluid.0=3").find("override \"fluid.0=3\": key \"fluid.0\" is unknown"), 0u);
    EXPECT_EQ(block_with("domain.max=[1,0,1]").find("override \"domain.max=[1,0,1]\": key \"domain.max\" is [1, 0, 1]"),
              0u);
}

TEST(SceneFile, TakesMeshesOfOverridesFromTheWorkingFolder)
{
    const std::string mesh = "[[fluid]]\nshape='mesh'\nmesh='a.obj'\nposition=[0,1,0]\n";
    const auto mesh_of = [](const Scene& scene) {
        return std::get<MeshShape>(scene.fluids[0].shape).mesh;
    };
    EXPECT_EQ(mesh_of(parse(mesh)), "/scenes/a.obj");
    EXPECT_EQ(mesh_of(parse(mesh, {"fluid.0.mesh=b.obj"})), (std::filesystem::current_path() / "b.obj").string());
    EXPECT_EQ(mesh_of(parse(mesh, {"fluid.0.mesh=builtin:cube"})), "builtin:cube");
}

TEST(SceneFileOnDisk, ReadsFiles)
{
    const test::ScratchFolder folder;
    test::write_bytes(folder / "a.toml", "[[fluid]]\nshape='mesh'\nmesh='a.obj'\nposition=[0,1,0]\n");
    const Scene scene = read_scene_file(folder / "a.toml", std::vector<std::string>{"seed=5"});
    EXPECT_EQ(scene.seed, 5u);
    EXPECT_EQ(std::get<MeshShape>(scene.fluids[0].shape).mesh, (folder / "a.obj").string());
}

TEST(SceneFileOnDisk, ANamelessSceneIsCalledAsItsFile)
{
    const test::ScratchFolder folder;
    test::write_bytes(folder / "tall wave.v2.toml", BLOCK);
    test::write_bytes(folder / "named.toml", "name = \"other\"\n" + std::string(BLOCK));
    test::write_bytes(folder / "\xff.toml", BLOCK); // no UTF-8
    EXPECT_EQ(read_scene_file(folder / "tall wave.v2.toml").name, "tall wave.v2");
    EXPECT_EQ(read_scene_file(folder / "tall wave.v2.toml", std::vector<std::string>{"name=mine"}).name, "mine");
    EXPECT_EQ(read_scene_file(folder / "named.toml").name, "other");
    EXPECT_EQ(read_scene_file(folder / "\xff.toml").name, "untitled");
}

TEST(SceneFileOnDisk, SaysWhyAFileCannotBeRead)
{
    const test::ScratchFolder folder;
    const auto write = [&](const std::string& name, const std::string& text) {
        test::write_bytes(folder / name, text);
        return folder / name;
    };
    const auto error = [](const std::filesystem::path& path) {
        return complaint_of([&] { read_scene_file(path); });
    };
    EXPECT_EQ(error(folder.path()), folder.path().string() + ": cannot read the scene: it is a folder");
    EXPECT_EQ(error(folder / "none.toml"),
              (folder / "none.toml").string() + ": cannot read the scene: No such file or directory");
    EXPECT_NE(error(write("big.toml", std::string((16 << 20) + 1, ' '))).find("larger than 16 MiB"), std::string::npos);
    EXPECT_NE(error(write("binary.toml", "\x89PNG\r\n\x1a\n")).find("binary.toml:1:"), std::string::npos);
    EXPECT_NE(error(write("letter.toml", "name = \"x\"\n\n\u00e9 = 1\n")).find("letter.toml:3"), std::string::npos);
    EXPECT_NE(error(write("letter.toml", "name = \"x\"\n\nse\u0245ed = 1\n")).find("letter.toml:3"), std::string::npos);
    for (const char* header : {"[,a]", "[[,a]]", "[ \t=]", "[[#\n]]", "[\x01"}) {
        EXPECT_NE(error(write("header.toml", std::string("name = \"x\"\n\n") + header + "\n")).find("header.toml:3"),
                  std::string::npos)
            << header;
    }
    EXPECT_NE(error("/dev/zero").find("larger than 16 MiB"), std::string::npos);
}

// --- the whole table -----------------------------------------------------------------------------

float random_number(Random& random, const ValueRule& rule)
{
    // Odd digits, well inside the range, so that no pair of keys contradicts itself.
    const double span = std::min(rule.max - rule.min, 2.0);
    const double middle = rule.min <= 0.0 && rule.max >= 1.0 ? 0.0 : rule.min;
    return static_cast<float>(middle + span * (0.1 + 0.3 * random.uniform()));
}

SceneValue random_value(Random& random, const ValueRule& rule)
{
    const auto number = [&] {
        return SceneValue{static_cast<double>(random_number(random, rule))};
    };
    const auto vector = [&] {
        return SceneValue{SceneValue::Array{number(), number(), number()}};
    };
    switch (rule.kind) {
    case ValueKind::Boolean:
        return {random.below(2) == 1};
    case ValueKind::Boolean3:
        return {SceneValue::Array{{random.below(2) == 1}, {random.below(2) == 1}, {random.below(2) == 1}}};
    case ValueKind::Integer:
        return {static_cast<std::int64_t>(rule.min) +
                random.below(static_cast<std::uint32_t>(std::min(rule.max - rule.min, 1e9)))};
    case ValueKind::Number:
        return number();
    case ValueKind::Vector2: {
        const double low = random_number(random, rule);
        return {SceneValue::Array{{low}, {low + 1.0}}};
    }
    case ValueKind::Vector3:
        return vector();
    case ValueKind::Matrix3:
        return {SceneValue::Array{vector(), vector(), vector()}};
    case ValueKind::Text:
        return {fmt::format("/\"\\\t\n\x01\x7f ü {}", random.next())};
    case ValueKind::Choice:
        return {std::string(rule.choices[random.below(static_cast<std::uint32_t>(rule.choices.size()))])};
    }
    return {};
}

template <class Owner>
void randomize(Random& random, std::span<const Key<Owner>> keys, Owner& owner, std::string_view shape)
{
    for (const Key<Owner>& key : keys) {
        if (key.name != "shape" && (key.shape.empty() || key.shape == shape)) {
            key.set(owner, random_value(random, key.rule));
        }
    }
}

/// A shape that no other key forbids.
template <class Shape>
void make_possible(Random& random, Shape& shape)
{
    if constexpr (std::is_same_v<Shape, BlockShape> || std::is_same_v<Shape, RainShape>) {
        shape.max = shape.min + 0.7f;
    } else if constexpr (std::is_same_v<Shape, InflowShape>) {
        shape.max = shape.min + glm::vec3(0.0f, 0.7f, 0.6f);
    } else if constexpr (std::is_same_v<Shape, SphereShape> || std::is_same_v<Shape, JetShape>) {
        shape.radius = 0.1f + static_cast<float>(random.uniform());
    }
}

/// Any scene, every key away from its default, as far as keys may not contradict each other.
Scene random_scene(std::uint64_t seed)
{
    Random random(seed);
    Scene scene;
    randomize(random, scene_keys(), scene, "");
    scene.domain = {.min = glm::vec3(-100.25f),
                    .max = glm::vec3(100.1f),
                    .walls = scene.domain.walls,
                    .wall_viscosity = scene.domain.wall_viscosity};
    scene.particles.spacing = 0.0123f;
    scene.physics.shifting = scene.solver == Solver::Pbf ? 0.0f : scene.physics.shifting;
    scene.time.dt = 1e-7f + 1e-8f * static_cast<float>(random.uniform());
    scene.camera.target = scene.camera.eye.value() + glm::vec3(1.5f, 0.0f, 0.0f);
    scene.camera.up = {0.1f, 0.9f, 0.0f};
    for_each_body_list(scene, [&](std::string_view, auto& bodies, const auto& keys) {
        for (const std::string_view shape : keys.front().rule.choices) {
            auto& body = bodies.emplace_back();
            keys.front().set(body, {std::string(shape)});
            randomize(random, keys, body, shape);
            std::visit([&](auto& its) { make_possible(random, its); }, body.shape);
        }
    });
    for (std::size_t i = 0; i < scene.solids.size(); ++i) { // a front has one or the other
        DissolveFront& front = scene.solids[i].dissolve;
        front.direction = (i + seed) % 2 == 0 ? front.direction : std::nullopt;
        front.point = (i + seed) % 2 == 0 ? std::nullopt : front.point;
    }
    for (FluidBody& fluid : scene.fluids) {
        fluid.temperature = fluid.thermal.melting_point + 3.5f;
    }
    for (SolidBody& solid : scene.solids) { // neither heat nor flow turns any into dust
        solid.temperature = solid.thermal.melting_point - 3.5f;
        if (solid.wind_erodes) { // nor does sand turn into fluid
            solid.melts = false;
            solid.erosion.erodes = false;
            solid.dissolve.speed = 0.0f;
            solid.lattice = BodyLattice::Cubic;                                                 // it stands in columns
            scene.physics.gravity = {0.0f, -0.7f - static_cast<float>(random.uniform()), 0.0f}; // it comes down
        }
        solid.becomes = solid.melts || solid.erosion.erodes ? SolidBecomes::Fluid : solid.becomes;
        const bool may_have_colors = solid.erosion.erodes && std::holds_alternative<MeshShape>(solid.shape);
        solid.erosion.strength_from = may_have_colors ? solid.erosion.strength_from : StrengthSource::Noise;
        solid.solid_density = solid.wind_erodes ? std::nullopt : std::optional(0.9f * solid.rest_density);
        solid.erosion.grain_size = std::nullopt; // grains are heavier than the fluid
    }
    scene.wind.direction = glm::vec3(scene.wind.direction.x, scene.wind.direction.y,
                                     scene.domain.dimensions == 2 ? 0.0f : scene.wind.direction.z);
    for (EmitterBody& emitter : scene.emitters) {
        emitter.fluid.temperature = emitter.fluid.thermal.melting_point + 3.5f;
        emitter.velocity.x += 3.0f;
        emitter.stop = emitter.start + 0.3f;
    }
    return scene;
}

/// Names of the keys in which two scenes differ.
std::vector<std::string> differences(const Scene& a, const Scene& b)
{
    std::vector<std::string> names;
    for (const SceneKey& key : scene_keys()) {
        if (key.get(a) != key.get(b)) {
            names.emplace_back(key.name);
        }
    }
    EXPECT_EQ(a.fluids.size(), b.fluids.size());
    EXPECT_EQ(a.solids.size(), b.solids.size());
    EXPECT_EQ(a.emitters.size(), b.emitters.size());
    EXPECT_EQ(a.sinks.size(), b.sinks.size());
    EXPECT_EQ(a.colliders.size(), b.colliders.size());
    const auto compare_bodies = [&](std::string_view list, const auto& of_a, const auto& of_b, const auto& keys) {
        for (std::size_t i = 0; i < std::min(of_a.size(), of_b.size()); ++i) {
            for (const auto& key : keys) {
                if (belongs_to(key, shape_name(of_a[i].shape)) && key.get(of_a[i]) != key.get(of_b[i])) {
                    names.push_back(fmt::format("{}.{}.{}", list, i, key.name));
                }
            }
        }
    };
    compare_bodies("fluid", a.fluids, b.fluids, fluid_keys());
    compare_bodies("solid", a.solids, b.solids, solid_keys());
    compare_bodies("emitter", a.emitters, b.emitters, emitter_keys());
    compare_bodies("sink", a.sinks, b.sinks, sink_keys());
    compare_bodies("collider", a.colliders, b.colliders, collider_keys());
    return names;
}

TEST(KeyTable, EveryKeyRoundTrips)
{
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const Scene scene = random_scene(seed);
        const std::string text = write_scene(scene);
        EXPECT_EQ(differences(parse(text), scene), std::vector<std::string>{}) << text;
        EXPECT_EQ(write_scene(parse(text)), text);
    }
    const Scene defaults = parse(BLOCK);
    EXPECT_EQ(differences(parse(write_scene(defaults)), defaults), std::vector<std::string>{});
}

TEST(KeyTable, EveryKeyHasAFieldOfItsOwn)
{
    // Changing one key changes that key alone.
    for (const SceneKey& key : scene_keys()) {
        Random random(7);
        Scene scene;
        while (key.rule.choices.size() != 1 && key.get(scene) == key.get(Scene{})) {
            key.set(scene, random_value(random, key.rule));
        }
        const std::vector<std::string> changed = differences(scene, Scene{});
        EXPECT_EQ(changed.size(), key.rule.choices.size() == 1 ? 0u : 1u) << key.name;
    }
}

TEST(KeyTable, DefaultsAreAllowed)
{
    for (const SceneKey& key : scene_keys()) {
        EXPECT_TRUE(accepts(key.rule, key.get(Scene{})) || key.rule.choices.size() == 1) << key.name;
        EXPECT_FALSE(key.description.empty()) << key.name;
    }
}

/// A value whose last number is `number`, the others the middle of the range.
SceneValue value_with(const ValueRule& rule, double number)
{
    const SceneValue middle{0.5 * (rule.min + rule.max)};
    const SceneValue::Array row{middle, middle, {number}};
    switch (rule.kind) {
    case ValueKind::Vector2:
        return {SceneValue::Array{middle, {number}}};
    case ValueKind::Vector3:
        return {row};
    case ValueKind::Matrix3:
        return {SceneValue::Array{{row}, {row}, {row}}};
    case ValueKind::Integer:
        return {static_cast<std::int64_t>(number)};
    case ValueKind::Text:
        return {std::string(static_cast<std::size_t>(std::max(number, 0.0)), 'x')};
    default:
        return {number};
    }
}

template <class Owner>
void expect_limits(std::span<const Key<Owner>> keys)
{
    for (const Key<Owner>& key : keys) {
        const ValueRule& rule = key.rule;
        if (rule.kind == ValueKind::Boolean || rule.kind == ValueKind::Boolean3 || rule.kind == ValueKind::Choice) {
            continue;
        }
        const bool counts = rule.kind == ValueKind::Integer || rule.kind == ValueKind::Text;
        const double step_down = counts ? 1.0 : std::max(1e-6, 1e-6 * std::abs(rule.min));
        const double step_up = counts ? std::max(1.0, 1e-3 * rule.max) : 1e-6 * rule.max;
        EXPECT_TRUE(accepts(rule, value_with(rule, rule.min))) << key.name;
        EXPECT_TRUE(accepts(rule, value_with(rule, rule.max))) << key.name;
        EXPECT_FALSE(accepts(rule, value_with(rule, rule.max + step_up))) << key.name;
        if (rule.kind != ValueKind::Text || rule.min > 0.0) {
            EXPECT_FALSE(accepts(rule, value_with(rule, rule.min - step_down))) << key.name;
        }
    }
}

TEST(KeyTable, LimitsAreInclusiveAndKept)
{
    expect_limits(scene_keys());
    expect_limits(fluid_keys());
    expect_limits(solid_keys());
    expect_limits(emitter_keys());
    expect_limits(sink_keys());
    expect_limits(collider_keys());
}

TEST(SceneCheck, WorksOnScenesBuiltInCode)
{
    Scene scene;
    scene.fluids.push_back({.shape = BlockShape{.min = glm::vec3(0.0f), .max = glm::vec3(1.0f)}});
    EXPECT_NO_THROW(validate_scene(scene));
    scene.seed = ~std::uint64_t{0};
    EXPECT_NE(complaint_of([&] { validate_scene(scene); }).find("scene \"untitled\": key \"seed\" is 1.8446744e+19"),
              std::string::npos);
    EXPECT_THROW(write_scene(scene), Error);
    scene.seed = 1;
    scene.physics.gravity.y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(complaint_of([&] { validate_scene(scene); }).find("is [0.0, nan, 0.0]"), std::string::npos);
    scene.physics.gravity.y = 0.0f;
    scene.name = "\xff";
    EXPECT_NE(complaint_of([&] { validate_scene(scene); }).find("of UTF-8"), std::string::npos);
    scene.name = "x";
    scene.fluids[0].shape = MeshShape{.mesh = "", .position = glm::vec3(0.0f)};
    EXPECT_NE(complaint_of([&] { validate_scene(scene); }).find("key \"fluid.0.mesh\""), std::string::npos);
}

// --- the scenes of apps/scenes -------------------------------------------------------------------

const std::filesystem::path scenes_folder = std::filesystem::path(MELTPOINT_SOURCE_DIR) / "apps/scenes";

TEST(BuiltinScenes, AreTheFilesOfTheFolder)
{
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(scenes_folder)) {
        files += entry.path().extension() == ".toml" ? 1 : 0;
    }
    EXPECT_EQ(builtin_scene_names().size(), files);
    for (const std::string& name : builtin_scene_names()) {
        const Scene scene = builtin_scene(name);
        EXPECT_EQ(scene.name, name);
        EXPECT_EQ(differences(scene, read_scene_file(scenes_folder / (name + ".toml"))), std::vector<std::string>{});
    }
    EXPECT_EQ(builtin_scene("drop", std::vector<std::string>{"time.frames=3"}).time.frames, 3u);
    EXPECT_EQ(complaint_of([] { builtin_scene("teapot_drip"); }),
              "no built-in scene is called \"teapot_drip\"; did you mean \"teapot_drop\"?");
    EXPECT_EQ(complaint_of([] { builtin_scene("x"); }),
              fmt::format("no built-in scene is called \"x\"; there are {}", fmt::join(builtin_scene_names(), ", ")));
}

TEST(SceneFile, NamedLiquidsGiveWhatTheSceneDoesNot)
{
    const std::string honey = std::string(BLOCK) + "liquid = \"honey\"\n";
    EXPECT_EQ(parse(honey).fluids[0].rest_density, 1400.0f);
    EXPECT_EQ(parse(honey).fluids[0].viscosity, 10.0f);
    EXPECT_EQ(parse(honey).fluids[0].color, find_liquid("honey")->color);
    EXPECT_EQ(parse(BLOCK).fluids[0].liquid, "custom");
    EXPECT_EQ(parse(BLOCK).fluids[0].rest_density, FluidBody{}.rest_density);
    EXPECT_FALSE(parse(BLOCK).fluids[0].viscosity.has_value());

    // What stands in the scene counts, wherever it stands, and so does an override.
    const Scene warm = parse(std::string(BLOCK) + "viscosity = 3.0\nrest_density = 1350\nliquid = \"honey\"\n");
    EXPECT_EQ(warm.fluids[0].rest_density, 1350.0f);
    EXPECT_EQ(warm.fluids[0].viscosity, 3.0f);
    const Scene lava = parse(honey, {"fluid.0.liquid=lava", "fluid.0.rest_density=2500"});
    EXPECT_EQ(lava.fluids[0].rest_density, 2500.0f);
    EXPECT_EQ(lava.fluids[0].viscosity, 100.0f);
    EXPECT_EQ(parse(honey, {"fluid.0.viscosity=7"}).fluids[0].viscosity, 7.0f);

    // Each has its own.
    const Scene two = parse(std::string(BLOCK) + "liquid = \"oil\"\n" + BLOCK + "liquid = \"water\"\n");
    EXPECT_EQ(two.fluids[0].viscosity, 0.084f);
    EXPECT_EQ(two.fluids[1].viscosity, 1.002e-3f);

    // Written and read again it is the same.
    EXPECT_EQ(write_scene(parse(write_scene(warm))), write_scene(warm));
}

TEST(SceneFile, AnUnknownLiquidIsToldTheNearestOne)
{
    const std::string complaint = complaint_of([] { parse(std::string(BLOCK) + "liquid = \"hony\"\n"); });
    EXPECT_NE(complaint.find("did you mean \"honey\"?"), std::string::npos) << complaint;
    EXPECT_NE(complaint.find("\"custom\", \"water\", \"oil\""), std::string::npos) << complaint;
}

TEST(SceneReference, IsUpToDate)
{
    const std::string reference = scene_reference_markdown();
    if (test::read_bytes(scenes_folder / "README.md") != reference) {
        const auto fresh = std::filesystem::current_path() / "scene_reference.md";
        std::ofstream(fresh, std::ios::binary) << reference;
        FAIL() << "apps/scenes/README.md is out of date: copy " << fresh << " over it";
    }
}

TEST(SceneReference, DefaultsAreThoseOfTheStruct)
{
    // The page as committed, read back row by row.
    std::istringstream lines(test::read_bytes(scenes_folder / "README.md"));
    int rows = 0;
    for (std::string line; std::getline(lines, line);) {
        const std::size_t name_end = line.find("` | `");
        if (!line.starts_with("| `") || name_end == std::string::npos) {
            continue;
        }
        const std::string name = line.substr(3, name_end - 3);
        const std::size_t begin = name_end + 5;
        const std::string value = line.substr(begin, line.find("` |", begin) - begin);
        const auto key = std::ranges::find(scene_keys(), name, &SceneKey::name);
        if (key != scene_keys().end()) {
            ++rows;
            EXPECT_EQ(to_toml(key->get(Scene{})), value) << name;
        }
    }
    EXPECT_EQ(rows, static_cast<int>(scene_keys().size()));
}

TEST(SceneFile, SurvivesMutations)
{
    Random random(42);
    const std::string original = test::read_bytes(scenes_folder / "drop.toml");
    const std::string alphabet = "[]{}=\"'.,#\n\\ 0-e_a\xff\x80";
    int read = 0;
    for (int round = 0; round < 3000; ++round) {
        std::string text = original;
        for (std::uint32_t edits = 1 + random.below(6); edits > 0; --edits) {
            const std::size_t at = random.below(static_cast<std::uint32_t>(text.size()));
            switch (random.below(4)) {
            case 0:
                text[at] = static_cast<char>(random.below(256));
                break;
            case 1:
                text.insert(at, 1, alphabet[random.below(static_cast<std::uint32_t>(alphabet.size()))]);
                break;
            case 2:
                text.erase(at, 1 + random.below(20));
                break;
            default:
                text.insert(at, original, random.below(static_cast<std::uint32_t>(original.size())), 30);
                break;
            }
        }
        try {
            const Scene scene = parse(text);
            EXPECT_EQ(differences(parse(write_scene(scene)), scene), std::vector<std::string>{});
            ++read;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::Input) << text;
            EXPECT_EQ(std::string(error.what()).find("test.toml:"), 0u) << error.what();
        }
    }
    EXPECT_GT(read, 100); // comments absorb some of the edits: both branches were seen
    EXPECT_LT(read, 2900);
}

constexpr std::string_view SOLID = "[[solid]]\nshape = \"sphere\"\ncenter = [0, 1, 0]\nradius = 0.4\n";

TEST(SceneFile, ASolidHasWhatItTurnsIntoAndAFront)
{
    const Scene scene =
        parse(std::string(SOLID) + "viscosity = 0.1\nliquid = \"oil\"\nfriction = 2\ncolor = [0.1, 0.2, 0.3]\n"
                                   "dissolve_speed = 0.3\ndissolve_start = 0.5\ndissolve_point = [0, 2, 0]\n");
    ASSERT_EQ(scene.solids.size(), 1u);
    const SolidBody& solid = scene.solids[0];
    EXPECT_EQ(std::get<SphereShape>(solid.shape).radius, 0.4f);
    EXPECT_EQ(solid.rest_density, 912.0f);
    EXPECT_EQ(solid.viscosity, 0.1f);
    EXPECT_EQ(solid.color, find_liquid("oil")->color);
    EXPECT_EQ(solid.solid_color, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(solid.friction, 2.0f);
    EXPECT_EQ(solid.dissolve.speed, 0.3f);
    EXPECT_EQ(solid.dissolve.start, 0.5f);
    EXPECT_EQ(solid.dissolve.point, glm::vec3(0.0f, 2.0f, 0.0f));
    EXPECT_FALSE(solid.dissolve.direction);
}

TEST(SceneFile, ContradictionsOfASolidAreNamed)
{
    const auto error = [](const std::string& lines) {
        return error_of(std::string(SOLID) + lines);
    };
    EXPECT_EQ(error("dissolve_direction = [0, 0, 0]"),
              "test.toml:5: key \"solid.0.dissolve_direction\" is [0, 0, 0], but must have a length");
    EXPECT_EQ(
        error("lattice = \"blue-noise\"\nwind_erodes = true"),
        "test.toml:5: key \"solid.0.lattice\" is \"blue-noise\", but sand (wind_erodes) stands in columns: it must "
        "be \"cubic\"");
    EXPECT_EQ(error("rest_density = 1000\nsolid_density = 700"),
              "test.toml:6: key \"solid.0.solid_density\" is 700 kg/m^3, but must be 0.75 to 1.25 times "
              "solid.0.rest_density = 1000 kg/m^3");
    EXPECT_EQ(error("rest_density = 1000\nsolid_density = 1100\nwind_erodes = true"),
              "test.toml:6: key \"solid.0.solid_density\" is 1100 kg/m^3, but sand (wind_erodes) has one density, "
              "solid.0.rest_density = 1000");
    EXPECT_EQ(
        error("erodes = true\nstrength_from = \"color\""),
        "test.toml:6: key \"solid.0.strength_from\" is \"color\", but only a shape \"mesh\" may have colors: those "
        "of its file");
    EXPECT_EQ(error_of("[[solid]]\nshape = \"mesh\"\nmesh = \"rock.ply\"\nposition = [0, 1, 0]\n"
                       "strength_from = \"color\""),
              "test.toml:5: key \"solid.0.strength_from\" is \"color\", but solid.0.erodes is false: only what flow "
              "erodes has a strength");
    EXPECT_NE(error("dissolve_direction = [0, 1, 0]\ndissolve_point = [0, 0, 0]")
                  .find("key \"solid.0.dissolve_direction\" is there beside solid.0.dissolve_point"),
              std::string::npos);
    EXPECT_NE(error("dissolve_speed = -1").find("must be"), std::string::npos);
    EXPECT_NE(error("velocity = [0, 1, 0]").find("is unknown"), std::string::npos); // it stands still
    EXPECT_NE(error("radius_ = 1").find("did you mean \"solid.0.radius\"?"), std::string::npos);
    EXPECT_NE(error_of("[[solid]]\nshape = \"sphere\"\ncenter = [0, 0.1, 0]\nradius = 0.4\n").find("inside the domain"),
              std::string::npos);
    EXPECT_NE(error_of("[domain]\ndimensions = 2\n" + std::string(SOLID) + "dissolve_direction = [0, 1, 1]")
                  .find("must have no z"),
              std::string::npos);
}

constexpr std::string_view JET =
    "[[emitter]]\nshape = \"jet\"\ncenter = [0, 1, 0]\nradius = 0.1\nvelocity = [0, -2, 0]\n";

TEST(Emitters, AreReadWithTheirShapes)
{
    const Scene scene =
        parse(std::string(JET) + "liquid = \"oil\"\nstart = 0.5\nstop = 2\nparticles = 700\n" +
              "[[emitter]]\nshape = \"rain\"\nmin = [-0.5, 1.5, -0.5]\nmax = [0.5, 1.5, 0.5]\nrate = 2\n" +
              "[[emitter]]\nshape = \"inflow\"\nmin = [-0.5, 0, -0.5]\nmax = [-0.5, 1, 0.5]\n" +
              "velocity = [1, 0, 0]\n[[sink]]\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 0.2\n");
    ASSERT_EQ(scene.emitters.size(), 3u);
    const EmitterBody& jet = scene.emitters[0];
    EXPECT_EQ(std::get<JetShape>(jet.shape).radius, 0.1f);
    EXPECT_EQ(jet.fluid.rest_density, 912.0f);
    EXPECT_EQ(jet.fluid.color, find_liquid("oil")->color);
    EXPECT_EQ(jet.velocity, glm::vec3(0.0f, -2.0f, 0.0f));
    EXPECT_EQ(jet.start, 0.5f);
    EXPECT_EQ(jet.stop, 2.0f);
    EXPECT_EQ(jet.particles, 700u);
    EXPECT_EQ(std::get<RainShape>(scene.emitters[1].shape).rate, 2.0f);
    EXPECT_EQ(std::get<InflowShape>(scene.emitters[2].shape).max, glm::vec3(-0.5f, 1.0f, 0.5f));
    EXPECT_FALSE(scene.emitters[2].stop);
    ASSERT_EQ(scene.sinks.size(), 1u);
    EXPECT_EQ(std::get<SphereShape>(scene.sinks[0].shape).radius, 0.2f);
}

TEST(Emitters, MistakesAreNamed)
{
    const auto error = [](const std::string& more) {
        return error_of(std::string(JET) + more);
    };
    const auto error_of_inflow = [](const std::string& corner, const std::string& velocity) {
        return error_of("[[emitter]]\nshape = \"inflow\"\nmin = [0, 0, 0]\nmax = " + corner +
                        "\nvelocity = " + velocity + "\n");
    };
    EXPECT_EQ(error("stop = -1"), "test.toml:6: key \"emitter.0.stop\" is -1, but must be a number from 0 to 1000000 s "
                                  "or \"auto\"");
    EXPECT_EQ(error("start = 2\nstop = 1"), "test.toml:7: key \"emitter.0.stop\" is 1 s, but must not be before "
                                            "emitter.0.start = 2 s");
    EXPECT_NE(error("min = [0, 0, 0]").find("but this emitter has shape = \"jet\" with the keys center, radius"),
              std::string::npos);
    EXPECT_EQ(
        error_of_inflow("[0, 1, 1]", "[0, 1, 0]"),
        "test.toml:5: key \"emitter.0.velocity\" is [0, 1, 0], but must lead through the rectangle, which is flat "
        "along x");
    EXPECT_NE(error_of_inflow("[1, 1, 1]", "[0, 1, 0]").find("but one, in which they are equal"), std::string::npos);
    EXPECT_NE(error_of_inflow("[0, 0, 1]", "[0, 1, 0]").find("but one, in which they are equal"), std::string::npos);
    EXPECT_NE(error_of_inflow("[0, 9, 1]", "[1, 0, 0]").find("inside the domain"), std::string::npos);
    EXPECT_NE(error_of_inflow("[0, 0.001, 1]", "[1, 0, 0]").find("thin"), std::string::npos);
    const std::string still = "[[emitter]]\nshape = \"jet\"\ncenter = [0, 1, 0]\nradius = 0.1\n";
    EXPECT_NE(error_of(still).find("a jet has a direction and a speed"), std::string::npos);
    std::string many;
    for (std::size_t i = 0; i < 17; ++i) {
        many += JET;
    }
    EXPECT_NE(error_of(many).find("is there 17 times, but a scene has at most 16 emitters"), std::string::npos);
    EXPECT_NE(error_of(std::string(JET) + "[[sink]]\nshape = \"mesh\"\n").find("\"block\" or \"sphere\""),
              std::string::npos);
}

} // namespace
} // namespace meltpoint
