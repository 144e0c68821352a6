// The program as a user meets it: run as a child process, judged by its exit code, its two streams and its files.

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/cli.h"
#include "support/clouds.h"
#include "support/mesh_files.h"
#include "support/scratch_folder.h"
#include "support/two_colors.h"

namespace meltpoint {
namespace {

using test::Arguments;
using test::Cli;
using test::expect_one_sentence;
using test::Result;
namespace fs = std::filesystem;

/// A coarse, small and quick run of a built-in scene.
Arguments quick(const std::string& out, const Arguments& more = {}, const std::string& scene = "dam_break")
{
    Arguments arguments{"render", scene,      "--out", out,     "--size",
                        "96x54",  "--frames", "3",     "--set", "particles.spacing=0.1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

bool is_png(const std::string& bytes)
{
    return bytes.starts_with("\x89PNG\r\n\x1a\n") && bytes.size() > 20 &&
           bytes.compare(bytes.size() - 8, 4, "IEND") == 0;
}

std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == separator) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

// --- help, version, usage ------------------------------------------------------------------------

TEST_F(Cli, HelpNamesEverySubcommandAndTheExitCodes)
{
    const Result result = run({"--help"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
    for (const char* part : {"render", "compare", "info", "--quiet", "--version", "Exit codes", "130"}) {
        EXPECT_NE(result.out.find(part), std::string::npos) << part;
    }
}

TEST_F(Cli, HelpOfEverySubcommandTellsUnitsAndDefaults)
{
    const std::map<std::string, Arguments> expected{
        {"render",
         {"--out", "[out/NAME", "--frames", "time.frames", "--size", "in pixels", "--video", "--particles", "--stats",
          "--forces", "SI units", "--device", "--set", "--validate", "--force"}},
        {"compare", {"--steps", "[50]", "--json", "--device", "--set", "--validate"}},
        {"follow", {"--particle", "[0]", "--steps", "[100]", "--device", "--set", "--validate"}},
        {"info", {"--device", "--json"}}};
    for (const auto& [subcommand, parts] : expected) {
        const Result result = run({subcommand, "--help"});
        EXPECT_EQ(result.exit_code, 0);
        EXPECT_EQ(result.err, "");
        EXPECT_NE(result.out.find("--quiet"), std::string::npos) << subcommand;
        for (const std::string& part : parts) {
            EXPECT_NE(result.out.find(part), std::string::npos) << subcommand << ": " << part << "\n" << result.out;
        }
    }
}

TEST_F(Cli, Version)
{
    const Result result = run({"--version"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.out.substr(0, 10), "meltpoint ");
    EXPECT_EQ(result.err, "");
}

TEST_F(Cli, WrongUsageExitsWithTwo)
{
    for (const Arguments& arguments : std::vector<Arguments>{{},
                                                             {"render"},
                                                             {"render", "drop", "extra"},
                                                             {"render", "drop", "--nonsense"},
                                                             {"render", "drop", "--frames", "0"},
                                                             {"render", "drop", "--frames", "-1"},
                                                             {"render", "drop", "--frames", "many"},
                                                             {"render", "drop", "--frames", "1e99"},
                                                             {"render", "drop", "--frames", "4", "--frames", "5"},
                                                             {"render", "drop", "--particles", "xyz"},
                                                             {"render", "drop", "--out"},
                                                             {"render", "drop", "--out", ""},
                                                             {"render", "drop", "--stats", ""},
                                                             {"render", "drop", "--mesh", ""},
                                                             {"bench", "--scene", ""},
                                                             {"report", "--out", ""},
                                                             {"info", "--device", ""},
                                                             {"compare", "drop", "--steps", "-1"},
                                                             {"follow", "drop", "--steps", "0"},
                                                             {"nonsense"}}) {
        const Result result = run(arguments);
        EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(arguments);
        EXPECT_EQ(result.out, "") << testing::PrintToString(arguments);
        EXPECT_NE(result.err, "") << testing::PrintToString(arguments);
    }
    expect_one_sentence(run({"nonsense"}), 2,
                        "there is no subcommand \"nonsense\"; there are render, sample, compare, follow, bench, "
                        "report, validate, info");
    EXPECT_TRUE(files(".").empty());
}

TEST_F(Cli, RendersAScanAsFluid)
{
    test::write_bytes(path("scan.xyz"), test::xyz_of(test::fibonacci_sphere(2000)));
    const std::string note = "scan.xyz: 2000 of 2000 normals were missing: they are estimated from nearest neighbors "
                             "and oriented outward";
    for (const Arguments& scene : {Arguments{"scan.xyz", "--set", "particles.spacing=0.2"},
                                   Arguments{"teapot_drop", "--mesh", "scan.xyz", "--set", "particles.spacing=0.05"}}) {
        Arguments arguments{"render", "--frames", "2", "--size", "96x54", "--force", "--out", "out"};
        arguments.insert(arguments.end(), scene.begin(), scene.end());
        const Result result = run(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        ASSERT_EQ(test::messages(result.err).size(), 2u) << result.err; // the other one tells of particles and device
        EXPECT_TRUE(test::messages(result.err)[0].ends_with(note)) << result.err;
        EXPECT_NE(result.out.find("2 frames of "), std::string::npos) << result.out;
        EXPECT_EQ(files("out"), (Arguments{"frame_0000.png", "frame_0001.png"}));
    }
}

TEST_F(Cli, ABedIsStrongWhereItsObjIsBright)
{
    const auto render = [&](const std::string& mesh, const std::string& content) {
        test::write_bytes(path(mesh), content);
        test::write_bytes(path("bed.toml"), R"(
domain = { min = [-0.5, 0, -0.2], max = [0.5, 1, 0.2] }
particles.spacing = 0.05
[[fluid]]
shape = "block"
min = [-0.5, 0.2, -0.2]
max = [0.5, 0.5, 0.2]
velocity = [0, 0, 1]
[[solid]]
shape = "mesh"
mesh = ")" + mesh + R"("
position = [0, 0.1, 0]
anchor = "all"
erodes = true
erosion_threshold = 0
erosion_rate = 300
strength_from = "color"
strength_contrast = 3
)");
        return run(
            {"render", "bed.toml", "--frames", "3", "--size", "96x54", "--force", "--out", "out", "--stats", "s.csv"});
    };
    const auto worn = [&](const std::string& mesh, const std::string& content) { // kg/s, of the last frame
        const Result result = render(mesh, content);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        const std::vector<std::string> lines = split(bytes("s.csv"), '\n');
        const std::vector<std::string> names = split(lines.at(0), ',');
        const auto column = std::find(names.begin(), names.end(), "rate_hydraulic") - names.begin();
        return std::stod(split(lines.at(3), ',').at(static_cast<std::size_t>(column)));
    };
    TriangleMesh bed = test::black_and_white_box({1.0f, 0.2f, 0.4f});
    const double half_black = worn("bed.ply", test::ascii_ply_of(bed));
    EXPECT_GT(half_black, 0.0);
    EXPECT_EQ(worn("bed.obj", test::obj_of(bed)), half_black);
    std::fill(bed.colors.begin(), bed.colors.end(), glm::u8vec3(255));
    EXPECT_LT(worn("bed.obj", test::obj_of(bed)), 0.2 * half_black);
    bed.colors.clear();
    expect_one_sentence(render("bed.obj", test::obj_of(bed)), 2,
                        "bed.obj has none that are read: those of the vertices of a mesh (.obj, .ply, .gltf, .glb)");
}

TEST_F(Cli, BadInputIsOneSentenceAndExitsWithTwo)
{
    test::write_bytes(path("empty.obj"), "");
    test::write_bytes(path("empty.toml"), "");
    test::write_bytes(path("nan.toml"), "[[fluid]]\nshape = \"block\"\nmin = [0, 0, 0]\nmax = [0.5, nan, 0.5]\n");
    test::write_bytes(path("binary.toml"), std::string("\0\1\2\xff", 4));
    test::write_bytes(path("flat.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    test::write_bytes(path("flat.xyz"), "0 0 0\n1 0 0\n1 0 1\n0 0 1\n0.5 0 0.5\n");
    fs::create_directory(path("folder"));
    const std::vector<std::pair<Arguments, std::string>> cases{
        {{"no_such_scene"}, "no scene or mesh \"no_such_scene\""},
        {{"folder"}, "it is a folder"},
        {{"empty.obj"}, "the file is empty"},
        {{"empty.toml"}, "a scene has at least one [[fluid]]"},
        {{"nan.toml"}, "nan.toml:4: key \"fluid.0.max\""},
        {{"binary.toml"}, "binary.toml"},
        {{"flat.obj"}, "encloses no volume"},
        {{"flat.xyz"}, "flat.xyz: the scan encloses no volume"},
        {{"teapot_drop", "--mesh", "flat.xyz"},
         "teapot_drop: fluid.0 (flat.xyz): the shape to fill encloses no volume"},
        {{"builtin:bunny"}, "bunny"},
        {{"drop", "--size", "96"}, "--size 96: expected WIDTHxHEIGHT"},
        {{"drop", "--size", "96x"}, "expected WIDTHxHEIGHT"},
        {{"drop", "--size", "-96x54"}, "expected WIDTHxHEIGHT"},
        {{"drop", "--size", "96x54 "}, "expected WIDTHxHEIGHT"},
        {{"drop", "--size", "99999999999x54"}, "expected WIDTHxHEIGHT"},
        {{"drop", "--size", "0x54"}, "render.width"},
        {{"drop", "--size", "96x100000"}, "key \"render.height\" is 100000, but must be"},
        {{"drop", "--set", "physics.viscosty=1"}, "did you mean \"physics.viscosity\"?"},
        {{"drop", "--set", "physics.viscosity=-1"}, "physics.viscosity"},
        {{"drop", "--set", "physics.viscosity="}, "physics.viscosity"},
        {{"drop", "--set", "viscosity"}, "viscosity"},
        {{"drop", "--set", "fluid.7.velocity=[0,0,0]"}, "fluid.7.velocity"},
        {{"drop", "--set", "particles.spacing=0.001"}, "more than the device can hold"},
        {{"drop", "--device", "nonsense"}, "no device is named like \"nonsense\""},
        {{"drop", "--device", "99"}, "there is no device 99"},
        {{"drop", "--video", "x.gif", "--set", "particles.spacing=0.1"}, "none of .mp4, .mkv, .mov"},
        {{"drop", "--stats", "x.mp4", "--video", "./x.mp4"}, "another output of this run has that name"},
        {{"drop", "--stats", "out/drop/frame_0003.png"}, "another output of this run has that name"},
        {{"drop", "--stats", "folder"}, "folder is a folder"},
        {{"teapot_pour", "--stats", "x.csv", "--forces", "./x.csv"}, "another output of this run has that name"},
        {{"teapot_pour", "--forces", "x.mp4", "--video", "x.mp4"}, "--forces x.mp4: another output of this run"},
        {{"drop", "--forces", "x.csv"}, "--forces x.csv: the scene has no colliders"},
        {{"drop", "--stats", "/dev/full", "--force"}, "not a file"},
    };
    for (const auto& [more, part] : cases) {
        Arguments arguments{"render"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        SCOPED_TRACE(testing::PrintToString(arguments));
        expect_one_sentence(run(arguments), 2, part);
    }
    expect_one_sentence(run({"follow", "drop", "--particle", "99999999"}), 2, "drop has particles 0 to");
    expect_one_sentence(run({"follow", "drop", "--set", "solver=dfsph"}), 2, "the passes of solver \"wcsph\" alone");
    expect_one_sentence(run({"follow", "lid_driven_cavity"}), 2,
                        "steps without shifting alone (--set physics.shifting=0)");
    expect_one_sentence(run({"follow", "water_drops", "--set", "solver=wcsph"}), 2,
                        "--set physics.tension_model=paper");
    for (const char* key : {"physics.xsph", "physics.vorticity_confinement"}) {
        expect_one_sentence(run({"follow", "drop", "--set", std::string(key) + "=0.1"}), 2, std::string(key) + "=0");
    }
    expect_one_sentence(run({"follow", "splat_sphere"}), 2, "splat_sphere has no particles to follow");
    EXPECT_FALSE(fs::exists(path("out")) && !fs::is_empty(path("out/drop")));
    EXPECT_TRUE(fs::exists("/dev/full") && !fs::is_regular_file("/dev/full"));
}

// --- info ----------------------------------------------------------------------------------------

TEST_F(Cli, InfoAsJsonIsJsonAlone)
{
    const Result result = run({"info", "--json"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
    const auto document = nlohmann::json::parse(result.out);
    ASSERT_FALSE(document["devices"].empty());
    EXPECT_TRUE(document["devices"][0].contains("missing"));
    EXPECT_EQ(std::ranges::count_if(document["devices"], [](const auto& device) { return device["chosen"] == true; }),
              1);
}

TEST_F(Cli, InfoTellsDevicesAndVersions)
{
    const Result result = run({"info"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
    for (const char* part : {"meltpoint ", "Vulkan loader", "* device ", "driver", "lacks", "particles"}) {
        EXPECT_NE(result.out.find(part), std::string::npos) << part;
    }
}

TEST_F(Cli, ResultsThatCannotBeWrittenAreAFailure)
{
    const Result result = run({"info"}, "/dev/full");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.err, "error: cannot write to the standard output: No space left on device\n");
}

TEST_F(Cli, WithoutADeviceOneSentence)
{
    set_environment("VK_ICD_FILENAMES", "/nowhere.json");
    set_environment("VK_DRIVER_FILES", "/nowhere.json");
    expect_one_sentence(run(quick("out")), 1, "Vulkan");
    expect_one_sentence(run({"info"}), 1, "Vulkan");
    EXPECT_FALSE(fs::exists(path("out")));
}

// --- render: files and streams -------------------------------------------------------------------

TEST_F(Cli, RenderWritesNumberedFramesWithParticlesBesideThem)
{
    const Result result = run(quick("out", {"--particles", "ply"}));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(files("out"), (Arguments{"frame_0000.png", "frame_0001.png", "frame_0002.png", "particles_0000.ply",
                                       "particles_0001.ply", "particles_0002.ply"}));
    for (const char* frame : {"out/frame_0000.png", "out/frame_0001.png", "out/frame_0002.png"}) {
        EXPECT_TRUE(is_png(bytes(frame))) << frame;
    }
    EXPECT_NE(bytes("out/frame_0000.png"), bytes("out/frame_0002.png"));
    EXPECT_NE(bytes("out/particles_0000.ply"), bytes("out/particles_0002.ply"));
    EXPECT_EQ(result.out.find("out: 3 frames of 128 particles"), 0u) << result.out;
    EXPECT_EQ(std::ranges::count(result.out, '\n'), 1);
    EXPECT_NE(result.err.find("frames 3/3"), std::string::npos) << result.err;
}

TEST_F(Cli, PlyHasEveryIdOnce)
{
    ASSERT_EQ(run(quick("out", {"--particles", "ply"})).exit_code, 0);
    const std::string text = bytes("out/particles_0002.ply");
    const std::size_t end = text.find("end_header\n");
    ASSERT_NE(end, std::string::npos);
    std::istringstream header(text.substr(0, end));
    const std::map<std::string, std::size_t> sizes{{"char", 1}, {"uchar", 1}, {"short", 2}, {"ushort", 2},
                                                   {"int", 4},  {"uint", 4},  {"float", 4}, {"double", 8}};
    std::size_t count = 0;
    std::size_t stride = 0;
    std::size_t id_offset = std::string::npos;
    for (std::string line; std::getline(header, line);) {
        const std::vector<std::string> words = split(line, ' ');
        if (words[0] == "element") {
            count = std::stoul(words[2]);
        } else if (words[0] == "property") {
            if (words[2] == "id") {
                id_offset = stride;
            }
            stride += sizes.at(words[1]);
        }
    }
    ASSERT_EQ(count, 128u);
    ASSERT_NE(id_offset, std::string::npos);
    const std::string body = text.substr(end + 11);
    ASSERT_EQ(body.size(), count * stride);
    std::vector<int> seen(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t id = 0;
        std::copy_n(body.data() + i * stride + id_offset, sizeof(id), reinterpret_cast<char*>(&id)); // NOLINT
        ASSERT_LT(id, count);
        ++seen[id];
    }
    EXPECT_EQ(std::ranges::count(seen, 1), 128);
}

TEST_F(Cli, QuietIsSilentButForTheResult)
{
    for (const Arguments& arguments : {quick("a", {"--quiet"}), quick("b", {"-q"})}) {
        const Result result = run(arguments);
        EXPECT_EQ(result.exit_code, 0);
        EXPECT_EQ(result.err, "");
        EXPECT_NE(result.out, "");
    }
    Arguments before{"--quiet"};
    const Arguments rest = quick("c");
    before.insert(before.end(), rest.begin(), rest.end());
    EXPECT_EQ(run(before).err, "");
}

TEST_F(Cli, ExistingOutputIsKeptUnlessForced)
{
    fs::create_directory(path("out"));
    test::write_bytes(path("out/frame_0001.png"), "mine");
    test::write_bytes(path("s.csv"), "mine too");
    expect_one_sentence(run(quick("out")), 2, "out/frame_0001.png exists: give --force");
    expect_one_sentence(run(quick("other", {"--stats", "s.csv"})), 2, "s.csv exists: give --force");
    EXPECT_EQ(files("."), (Arguments{"out", "s.csv"}));
    EXPECT_EQ(files("out"), (Arguments{"frame_0001.png"}));
    EXPECT_EQ(bytes("out/frame_0001.png"), "mine");
    EXPECT_EQ(bytes("s.csv"), "mine too");

    EXPECT_EQ(run(quick("out", {"--force", "--stats", "s.csv"})).exit_code, 0);
    EXPECT_EQ(files("out").size(), 3u);
    EXPECT_TRUE(is_png(bytes("out/frame_0001.png")));
    EXPECT_TRUE(bytes("s.csv").starts_with("frame,time,"));
}

TEST_F(Cli, ForceTakesAwayTheFramesOfALongerRunButOnlyWhenItCanReplaceThem)
{
    fs::create_directory(path("out"));
    for (int frame = 0; frame < 6; ++frame) {
        test::write_bytes(path("out/frame_000" + std::to_string(frame) + ".png"), "old");
        test::write_bytes(path("out/particles_000" + std::to_string(frame) + ".ply"), "old");
    }
    test::write_bytes(path("out/notes.txt"), "mine");
    EXPECT_EQ(run(quick("out", {"--force", "--set", "particles.spacing=0.0001"})).exit_code, 2);
    EXPECT_EQ(files("out").size(), 13u);
    EXPECT_EQ(run(quick("out", {"--force"})).exit_code, 0);
    EXPECT_EQ(files("out"), (Arguments{"frame_0000.png", "frame_0001.png", "frame_0002.png", "notes.txt"}));
}

TEST_F(Cli, OddPathsAndNames)
{
    EXPECT_EQ(run(quick("a b/ü/日本")).exit_code, 0);
    EXPECT_EQ(files("a b/ü/日本").size(), 3u);
    test::write_bytes(
        path("-x.toml"),
        "name = \"../up/../../\\u001bx\\n\"\n[[fluid]]\nshape = \"block\"\nmin = [0, 0, 0]\nmax = [0.3, 0.3, 0.3]\n");
    EXPECT_EQ(
        run({"render", "./-x.toml", "--frames", "1", "--size", "96x54", "--set", "particles.spacing=0.1"}).exit_code,
        0);
    EXPECT_EQ(files("out"), (Arguments{".._up_.._..__x_"}));
    test::write_bytes(path("file"), "");
    expect_one_sentence(run(quick("file")), 1, "cannot make the folder file");
    expect_one_sentence(run(quick("file/below")), 1, "cannot make the folder file/below");
}

TEST_F(Cli, IterationsOfSolvedPressureAreInTheStats)
{
    const Result output = run(quick("out", {"--set", "solver=dfsph", "--stats", "s.csv"}));
    ASSERT_EQ(output.exit_code, 0);
    const std::vector<std::string> lines = split(bytes("s.csv"), '\n');
    const std::vector<std::string> cells = split(lines[3], ',');
    ASSERT_EQ(cells.size(), 45u);
    EXPECT_GE(std::stod(cells[31]), 1.0);
    EXPECT_GE(std::stod(cells[32]), 1.0);
    const Result short_of = run(quick("out2", {"--set", "solver=dfsph", "--set", "solve.max_iterations=1", "--set",
                                               "solve.density_error=1e-6", "--set", "time.frames=20"}));
    ASSERT_EQ(short_of.exit_code, 0);
    EXPECT_NE(short_of.err.find("density solves ended at 1 iterations"), std::string::npos) << short_of.err;
}

TEST_F(Cli, ForcesHaveARowAFrameAndCollider)
{
    test::write_bytes(path("pool.toml"),
                      "[domain]\nmin = [0, 0, 0]\nmax = [0.6, 0.8, 0.6]\n[particles]\nspacing = 0.05\n"
                      "[[fluid]]\nshape = \"block\"\nmin = [0, 0.1, 0]\nmax = [0.6, 0.4, 0.6]\n"
                      "[[collider]]\nshape = \"block\"\nmin = [0, 0.05, 0]\nmax = [0.6, 0.05, 0.6]\n"
                      "[[collider]]\nshape = \"sphere\"\ncenter = [0.3, 0.7, 0.3]\nradius = 0.08\n");
    for (const std::string solver : {"wcsph", "dfsph"}) {
        const Result result = run({"render", "pool.toml", "--out", solver, "--size", "96x54", "--frames", "6", "--set",
                                   "solver=" + solver, "--forces", solver + ".csv"});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        const std::vector<std::string> lines = split(bytes(solver + ".csv"), '\n');
        ASSERT_EQ(lines.size(), 14u); // a header, two rows for each of six frames, nothing after the last newline
        EXPECT_EQ(lines[0], "frame,time,collider,force_x,force_y,force_z,pressure_x,pressure_y,pressure_z,friction_x,"
                            "friction_y,friction_z,torque_x,torque_y,torque_z");
        EXPECT_EQ(lines[1], "0,0,0,,,,,,,,,,,,");
        const std::vector<std::string> plate = split(lines[11], ',');
        ASSERT_EQ(plate.size(), 15u);
        EXPECT_EQ(plate[0], "5");
        EXPECT_EQ(plate[2], "0");
        EXPECT_LT(std::stod(plate[4]), -100.0); // N: water weighs on it, on both sides of rest
        EXPECT_EQ(plate[4], plate[7]);
        const std::vector<std::string> ball = split(lines[12], ',');
        EXPECT_EQ(ball[2], "1");
        EXPECT_EQ(std::stod(ball[4]), 0.0); // in the air
    }
    expect_one_sentence(run({"render", "pool.toml", "--out", "pbf", "--set", "solver=pbf", "--forces", "pbf.csv"}), 2,
                        "knows no forces on colliders");
}

TEST_F(Cli, PositionBasedFluidsSayWhatTheyTookAndWhomTheySlowedDown)
{
    const Result output = run(quick("out", {"--set", "solver=pbf", "--stats", "s.csv"}));
    ASSERT_EQ(output.exit_code, 0);
    EXPECT_EQ(output.err.find("slowed down"), std::string::npos) << output.err;
    const std::vector<std::string> cells = split(split(bytes("s.csv"), '\n')[3], ',');
    ASSERT_EQ(cells.size(), 45u);
    EXPECT_GE(std::stod(cells[31]), 1.0);
    EXPECT_EQ(cells[32], "") << "positions have no divergence";
    const Result slow =
        run(quick("out2", {"--set", "solver=pbf", "--set", "pbf.iterations=3", "--stats", "t.csv", "--set",
                           "time.dt=0.008", "--set", "pbf.speed_cap=0.05", "--set", "fluid.0.velocity=[2,0,0]"}));
    ASSERT_EQ(slow.exit_code, 0);
    EXPECT_EQ(split(split(bytes("t.csv"), '\n')[3], ',')[31], "3");
    EXPECT_NE(slow.err.find("were slowed down in a step, to 0.05 spacings"), std::string::npos) << slow.err;
}

TEST_F(Cli, StatsHaveARowAFrame)
{
    ASSERT_EQ(run(quick("out", {"--stats", "deep/er/s.csv"})).exit_code, 0);
    const std::vector<std::string> lines = split(bytes("deep/er/s.csv"), '\n');
    ASSERT_EQ(lines.size(), 5u); // a header, three frames, nothing after the last newline
    EXPECT_EQ(lines.back(), "");
    const std::vector<std::string> names = split(lines[0], ',');
    ASSERT_EQ(names.size(), 45u);
    std::vector<std::map<std::string, double>> rows;
    for (std::size_t i = 1; i <= 3; ++i) {
        const std::vector<std::string> cells = split(lines[i], ',');
        ASSERT_EQ(cells.size(), names.size());
        std::map<std::string, double>& row = rows.emplace_back();
        for (std::size_t k = 0; k < names.size(); ++k) {
            const bool of_erosion = names[k].starts_with("rate_") || names[k] == "deposited" ||
                                    names[k] == "enthalpy" || names[k] == "exposed_area" || names[k] == "fragments";
            if (!names[k].starts_with("iterations_") && !of_erosion) {
                row[names[k]] = std::stod(cells[k]);
            } else {
                EXPECT_EQ(cells[k], "") << "nothing is solved for";
            }
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(rows[i]["frame"], static_cast<double>(i));
        EXPECT_NEAR(rows[i]["time"], static_cast<double>(i) / 60.0, 1e-6);
        EXPECT_NEAR(rows[i]["steps"] * rows[i]["dt"], rows[i]["time"], 1e-9);
        EXPECT_EQ(rows[i]["fluid"], 128.0);
        EXPECT_EQ(rows[i]["mass"], rows[0]["mass"]) << "to the last bit";
        EXPECT_EQ(rows[i]["outside"], 0.0);
        EXPECT_EQ(rows[i]["solid"] + rows[i]["dust"] + rows[i]["collider"] + rows[i]["dead"], 0.0);
        EXPECT_GT(rows[i]["neighbors_mean"], 5.0);
        EXPECT_LE(rows[i]["min_y"], rows[i]["com_y"]);
        EXPECT_GE(rows[i]["max_y"], rows[i]["com_y"]);
    }
    EXPECT_NEAR(rows[0]["mass"], 1000.0 * 0.4 * 0.8 * 0.4, 1e-3);
    EXPECT_EQ(rows[0]["kinetic_energy"], 0.0);
    EXPECT_GT(rows[2]["kinetic_energy"], 0.0);
    EXPECT_LT(rows[2]["potential_energy"], rows[0]["potential_energy"]);
}

TEST_F(Cli, RerunsAreTheSameToTheBit)
{
    const Arguments with_particles{"--particles", "ply"};
    set_environment("LP_NUM_THREADS", "1");
    ASSERT_EQ(run(quick("one", with_particles, "drop")).exit_code, 0);
    set_environment("LP_NUM_THREADS", "2");
    ASSERT_EQ(run(quick("two", with_particles, "drop")).exit_code, 0);
    ASSERT_EQ(run(quick("again", with_particles, "drop")).exit_code, 0);
    for (const std::string& file : files("one")) {
        EXPECT_EQ(bytes("one/" + file), bytes("two/" + file)) << file;
        EXPECT_EQ(bytes("two/" + file), bytes("again/" + file)) << file;
    }
}

TEST_F(Cli, ValidationIsSilentOnTheDefaultScene)
{
    const Result result = run({"render", "teapot_drop", "--validate", "--frames", "2", "--size", "96x54", "--set",
                               "particles.spacing=0.06", "--out", "out"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
}

// --- render: video -------------------------------------------------------------------------------

TEST_F(Cli, VideoIsWrittenWhereFfmpegIs)
{
    if (shell("command -v ffmpeg").exit_code != 0) {
        GTEST_SKIP() << "no ffmpeg here";
    }
    const Result result = run(quick("out", {"--video", "a:b/clip.mp4"}));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(files("a:b"), (Arguments{"clip.mp4"}));
    EXPECT_EQ(bytes("a:b/clip.mp4").substr(4, 4), "ftyp");
    expect_one_sentence(run(quick("other", {"--video", "a:b/clip.mp4"})), 2, "a:b/clip.mp4 exists");
}

TEST_F(Cli, WithoutFfmpegOneSentence)
{
    set_environment("PATH", "");
    expect_one_sentence(run(quick("out", {"--video", "clip.mp4"})), 1, "--video needs the program ffmpeg");
    EXPECT_FALSE(fs::exists(path("clip.mp4")));
    EXPECT_TRUE(files("out").empty());
}

// --- render: things that go wrong while it runs --------------------------------------------------

TEST_F(Cli, ABreakdownNamesStepAndParticleAndKeepsTheFramesBefore)
{
    const Result result = run({"render", "dam_break", "--out", "out", "--size", "96x54", "--frames", "9", "--stats",
                               "s.csv", "--set", "particles.spacing=0.1", "--set", "time.dt=0.01"});
    expect_one_sentence(result, 1, "the simulation broke down in step ");
    EXPECT_NE(result.err.find("at particle "), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("warning: dam_break: time.dt is 0.01 s, above the CFL bound of "), std::string::npos)
        << result.err;
    const std::vector<std::string> frames = files("out");
    EXPECT_GE(frames.size(), 1u);
    EXPECT_LT(frames.size(), 9u);
    for (const std::string& frame : frames) {
        EXPECT_TRUE(is_png(bytes("out/" + frame))) << frame;
    }
    EXPECT_EQ(std::ranges::count(bytes("s.csv"), '\n'), static_cast<std::ptrdiff_t>(frames.size()) + 1);
}

TEST_F(Cli, AFullDiskIsOneSentenceAndLeavesNoHalfFile)
{
    // A limit on the size of files stands for the full disk: the PNG fits, the particles do not.
    const Result result = shell("ulimit -f 8; exec \"$P\" render dam_break --out out --size 96x54 --frames 3 --set "
                                "particles.spacing=0.05 --particles ply");
    expect_one_sentence(result, 1, "cannot write out/particles_0000.ply: ");
    EXPECT_EQ(files("out"), (Arguments{"frame_0000.png"}));
    EXPECT_TRUE(is_png(bytes("out/frame_0000.png")));
}

TEST_F(Cli, AVideoThatTheDiskCannotHoldIsAFailure)
{
    if (shell("command -v ffmpeg").exit_code != 0) {
        GTEST_SKIP() << "no ffmpeg here";
    }
    const Result result = shell("ulimit -f 4; exec \"$P\" render dam_break --out out --size 96x54 --frames 60 --set "
                                "particles.spacing=0.1 --video clip.mp4");
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_NE(result.err.find("error: writing clip.mp4 failed"), std::string::npos) << result.err;
    EXPECT_EQ(files("."), (Arguments{"out"}));
    EXPECT_EQ(files("out").size(), 60u);
}

TEST_F(Cli, CtrlCFinishesTheFrameAndLeavesWholeFiles)
{
    const pid_t child = start({"render", "dam_break", "--out", "out", "--size", "96x54", "--frames", "100000",
                               "--stats", "s.csv", "--set", "particles.spacing=0.1", "--particles", "ply"});
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (!fs::exists(path("out/frame_0001.png")) && std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    const Result second =
        shell("exec \"$P\" render dam_break --out out --force --size 96x54 --set particles.spacing=0.1 2>second");
    EXPECT_EQ(second.exit_code, 2);
    EXPECT_EQ(bytes("second"), "error: out: another run is writing into this folder\n");
    kill(child, SIGINT);
    const Result result = finish(child);
    EXPECT_EQ(result.exit_code, 130) << result.err;
    EXPECT_NE(result.err.find("\ninterrupted: ends after this frame; once more ends at once\n"), std::string::npos)
        << result.err;
    EXPECT_NE(result.err.find("interrupted after "), std::string::npos) << result.err;
    std::size_t frames = 0;
    std::size_t particles = 0;
    for (const std::string& file : files("out")) {
        const bool is_frame = file.starts_with("frame_");
        (is_frame ? frames : particles)++;
        EXPECT_TRUE(is_frame ? is_png(bytes("out/" + file)) : file.starts_with("particles_")) << file;
    }
    EXPECT_GE(frames, 2u);
    EXPECT_LT(frames, 100000u);
    EXPECT_EQ(particles, frames);
    EXPECT_EQ(std::ranges::count(bytes("s.csv"), '\n'), static_cast<std::ptrdiff_t>(frames) + 1);
    EXPECT_EQ(result.out.find("out: " + std::to_string(frames) + " frames"), 0u) << result.out;
}

// --- compare -------------------------------------------------------------------------------------

TEST_F(Cli, CompareAgreesAndPrintsJsonAlone)
{
    const Result result =
        run({"compare", "dam_break", "--steps", "2", "--json", "--set", "particles.spacing=0.1", "--validate"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const auto document = nlohmann::json::parse(result.out);
    EXPECT_EQ(document["conforms"], true);
    EXPECT_EQ(document["particles"], 128);
    EXPECT_GT(document["results"].size(), 5u);
    for (const auto& each : document["results"]) {
        EXPECT_LE(each["error"].get<double>(), each["bound"].get<double>()) << each.dump();
    }
}

/// Where pressure is solved for, the density pass leaves the pressure of the step before, colliders' places included.
TEST_F(Cli, CompareAgreesWhereFluidUnderPressureMeetsACollider)
{
    test::write_bytes(path("pool.toml"), "particles.spacing = 0.05\n"
                                         "domain = {min = [0, 0, 0], max = [0.4, 0.4, 0.4]}\n"
                                         "fluid = [{shape = 'block', min = [0, 0, 0], max = [0.4, 0.2, 0.4]}]\n"
                                         "collider = [{shape = 'sphere', center = [0.2, 0.15, 0.2], radius = 0.1}]\n");
    for (const char* solver : {"wcsph", "dfsph", "pbf"}) {
        const Result result =
            run({"compare", "pool.toml", "--steps", "3", "--set", std::string("solver=") + solver, "--quiet"});
        EXPECT_EQ(result.exit_code, 0) << solver << "\n" << result.out << result.err;
    }
}

TEST_F(Cli, ComparePrintsATable)
{
    const Result result = run({"compare", "dam_break", "--steps", "0", "--set", "particles.spacing=0.1", "--quiet"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    for (const char* part : {"density", "bound", "ok", "The device agrees"}) {
        EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
    }
    expect_one_sentence(run({"compare", "no_such_scene"}), 2, "no scene or mesh");
}

} // namespace
} // namespace meltpoint
