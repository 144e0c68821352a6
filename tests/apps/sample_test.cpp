// `meltpoint sample` as a user meets it.

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "geometry/builtin_meshes.h"
#include "io/point_cloud_import.h"
#include "support/cli.h"
#include "support/clouds.h"
#include "support/mesh_files.h"
#include "support/scratch_folder.h"

namespace meltpoint {
namespace {

namespace fs = std::filesystem;
using test::Arguments;
using test::expect_one_sentence;
using test::Result;

class SampleCli : public test::Cli {
protected:
    Result sample(const Arguments& arguments) const
    {
        Arguments all{"sample"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return run(all);
    }

    nlohmann::json sample_json(Arguments arguments) const
    {
        arguments.emplace_back("--json");
        const Result result = sample(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(result.err, "");
        return nlohmann::json::parse(result.out);
    }

    void write(const std::string& name, const std::string& content) const { test::write_bytes(path(name), content); }
};

TEST_F(SampleCli, JsonHasExactlyTheKeysPromised)
{
    const nlohmann::json json =
        sample_json({"builtin:sphere", "-o", "s.ply", "--count", "5000", "--rest-density", "500"});
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items()) {
        keys.push_back(key);
    }
    EXPECT_EQ(keys, (std::vector<std::string>{"area", "boundary_edges", "interior_points", "nonmanifold_edges",
                                              "particle_mass", "seconds", "spacing", "surface_points", "triangles",
                                              "volume"}));
    constexpr double pi = 3.14159265358979;
    EXPECT_EQ(json["triangles"], builtin_mesh("sphere").triangles.size());
    EXPECT_EQ(json["boundary_edges"], 0);
    EXPECT_EQ(json["nonmanifold_edges"], 0);
    EXPECT_NEAR(json["area"], 4.0 * pi, 0.1);
    EXPECT_NEAR(json["volume"], 4.0 / 3.0 * pi, 0.04);
    EXPECT_EQ(json["surface_points"], 5000);
    EXPECT_EQ(json["interior_points"], 0);
    EXPECT_NEAR(json["spacing"], std::sqrt(json["area"].get<double>() / 5000.0), 1e-12);
    EXPECT_NEAR(json["particle_mass"], 500.0 * json["volume"].get<double>() / 5000.0, 1e-9);
    for (const char* stage : {"load", "sample", "measure", "save"}) {
        EXPECT_GE(json["seconds"][stage].get<double>(), 0.0) << stage;
    }
    const PointCloud cloud = import_point_cloud(path("s.ply"));
    ASSERT_EQ(cloud.size(), 5000u);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        ASSERT_GT(glm::dot(cloud.normals.at(i), cloud.positions[i]), 0.95f);
    }
}

TEST_F(SampleCli, EveryMethodTakesExactlyTheCount)
{
    for (const char* method : {"random", "stratified", "blue-noise"}) {
        const auto json =
            sample_json({"builtin:torus", "-o", "s.xyz", "--count", "777", "--method", method, "--force"});
        EXPECT_EQ(json["surface_points"], 777) << method;
        EXPECT_EQ(import_point_cloud(path("s.xyz")).size(), 777u) << method;
    }
    const auto json = sample_json({"builtin:cube", "-o", "s.xyz", "--spacing", "0.1", "--force"});
    EXPECT_EQ(json["surface_points"], 600);
    EXPECT_NEAR(json["spacing"], 0.1, 1e-9);
}

TEST_F(SampleCli, VolumesHoldTheCountWithinTwoPercent)
{
    for (const char* lattice : {"cubic", "bcc", "fcc"}) {
        const auto json = sample_json(
            {"builtin:torus", "-o", "v.ply", "--volume", "--count", "3000", "--lattice", lattice, "--force"});
        EXPECT_EQ(json["surface_points"], 0);
        const auto points = json["interior_points"].get<double>();
        EXPECT_NEAR(points, 3000.0, 60.0) << lattice;
        EXPECT_NEAR(json["particle_mass"], 1000.0 * json["volume"].get<double>() / points, 1e-9);
        const PointCloud cloud = import_point_cloud(path("v.ply"));
        EXPECT_EQ(cloud.size(), points);
        EXPECT_TRUE(cloud.normals.empty());
    }
}

TEST_F(SampleCli, BlueNoiseFillsWithExactlyTheCount)
{
    const auto json =
        sample_json({"builtin:torus", "-o", "v.ply", "--volume", "--count", "600", "--lattice", "blue-noise"});
    EXPECT_EQ(json["interior_points"], 600);
    EXPECT_NEAR(json["spacing"], std::cbrt(json["volume"].get<double>() / 600.0), 1e-9);
    const PointCloud cloud = import_point_cloud(path("v.ply"));
    ASSERT_EQ(cloud.size(), 600u);
    double nearest = 1.0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const glm::vec3& p = cloud.positions[i];
        ASSERT_LT(std::hypot(std::hypot(p.x, p.z) - 1.0f, p.y), 0.4f);
        for (std::size_t j = 0; j < i; ++j) {
            nearest = std::min(nearest, double(glm::distance(p, cloud.positions[j])));
        }
    }
    EXPECT_GT(nearest, 0.6 * json["spacing"].get<double>());
    EXPECT_EQ(
        sample({"builtin:torus", "-o", "w.ply", "--volume", "--count", "600", "--lattice", "blue-noise", "--seed", "2"})
            .exit_code,
        0);
    EXPECT_NE(bytes("v.ply"), bytes("w.ply"));
}

/// A quad, black on the left and reddish on the right.
TriangleMesh colored_quad()
{
    return {.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
            .triangles = {{0, 1, 2}, {0, 2, 3}},
            .normals = {},
            .colors = {{0, 0, 0}, {200, 100, 0}, {200, 100, 0}, {0, 0, 0}}};
}

TEST_F(SampleCli, PointsHaveTheColorsOfAMeshInEveryFormat)
{
    write("m.ply", test::ascii_ply_of(colored_quad()));
    write("m.obj", test::obj_of(colored_quad()));
    write("m.gltf", test::gltf_of(colored_quad()));
    write("m.glb", test::glb_of(colored_quad()));
    for (const std::string name : {"m.ply", "m.obj", "m.gltf", "m.glb"}) {
        EXPECT_EQ(sample({name, "-o", "of_" + name + ".ply", "--count", "500"}).exit_code, 0) << name;
        EXPECT_EQ(bytes("of_" + name + ".ply"), bytes("of_m.ply.ply")) << name;
    }
    const PointCloud cloud = import_point_cloud(path("of_m.ply.ply"));
    ASSERT_EQ(cloud.colors.size(), 500u);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        ASSERT_NEAR(cloud.colors[i].r, 200.0f * cloud.positions[i].x, 0.51f);
    }
    write("nan.obj", "v 0 0 0 1 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expect_one_sentence(sample({"nan.obj", "-o", "nan.ply"}), 2, "nan.obj:1: a color is not a finite number");
}

// --- clouds of points ----------------------------------------------------------------------------

/// A sphere as an ASCII PLY: colored by height and, where asked, with normals.
std::string sphere_ply(std::size_t count, bool normals)
{
    const PointCloud cloud = test::fibonacci_sphere(count);
    std::string text = fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
                                   "property float z\n{}property uchar red\nproperty uchar green\nproperty uchar "
                                   "blue\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n",
                                   count, normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "");
    for (const glm::vec3& p : cloud.positions) {
        text += fmt::format("{} {} {}", p.x, p.y, p.z);
        text += normals ? fmt::format(" {} {} {}", p.x, p.y, p.z) : "";
        text += p.y > 0.0f ? " 255 128 0\n" : " 0 0 9\n";
    }
    return text;
}

TEST_F(SampleCli, ACloudKeepsItsPointsAndGetsNormals)
{
    write("cloud.ply", sphere_ply(2000, false));
    const Result result = sample({"cloud.ply", "-o", "out.ply", "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "cloud.ply: 2000 of 2000 normals were missing: they are estimated from nearest neighbors "
                          "and oriented outward\n");
    const auto json = nlohmann::json::parse(result.out);
    constexpr double pi = 3.14159265358979;
    EXPECT_EQ(json["triangles"], 0);
    EXPECT_EQ(json["boundary_edges"], 0);
    EXPECT_EQ(json["nonmanifold_edges"], 0);
    EXPECT_NEAR(json["area"], 4.0 * pi, 0.01 * 4.0 * pi);
    EXPECT_NEAR(json["volume"], 4.0 / 3.0 * pi, 0.02 * 4.0 / 3.0 * pi);
    EXPECT_EQ(json["surface_points"], 2000);
    EXPECT_EQ(json["interior_points"], 0);
    EXPECT_NEAR(json["spacing"], std::sqrt(json["area"].get<double>() / 2000.0), 1e-12);
    EXPECT_NEAR(json["particle_mass"], 1000.0 * json["volume"].get<double>() / 2000.0, 1e-9);
    const nlohmann::json cloud_json{{"points", 2000},       {"duplicates", 0},
                                    {"normals_given", 0},   {"normals_estimated", 2000},
                                    {"normals_unknown", 0}, {"pieces_oriented", 1}};
    EXPECT_EQ(json["cloud"], cloud_json);
    for (const char* stage : {"load", "normals", "sample", "measure", "save"}) {
        EXPECT_GE(json["seconds"][stage].get<double>(), 0.0) << stage;
    }
    const PointCloud in = import_point_cloud(path("cloud.ply"));
    const PointCloud out = import_point_cloud(path("out.ply"));
    EXPECT_EQ(out.positions, in.positions);
    EXPECT_EQ(out.colors, in.colors);
    ASSERT_EQ(out.normals.size(), 2000u);
    for (std::size_t i = 0; i < out.size(); ++i) {
        ASSERT_GT(glm::dot(out.normals[i], out.positions[i]), 0.999f);
    }
}

TEST_F(SampleCli, NormalsOfACloudAreKeptInSilence)
{
    write("cloud.ply", sphere_ply(2000, true));
    const auto json = sample_json({"cloud.ply", "-o", "out.xyz"}); // nothing on stderr
    EXPECT_EQ(json["cloud"]["normals_given"], 2000);
    EXPECT_EQ(json["cloud"]["normals_estimated"], 0);
    const PointCloud in = import_point_cloud(path("cloud.ply"));
    const PointCloud out = import_point_cloud(path("out.xyz"));
    ASSERT_EQ(out.normals.size(), 2000u);
    for (std::size_t i = 0; i < out.size(); ++i) {
        ASSERT_LT(glm::distance(out.normals[i], in.normals[i]), 1e-6f);
    }
    write("bare.ply", sphere_ply(2000, false));
    EXPECT_EQ(run({"--quiet", "sample", "bare.ply", "-o", "out.ply"}).err, "");
}

TEST_F(SampleCli, ACloudIsFilled)
{
    write("cloud.ply", sphere_ply(3000, false));
    constexpr double ball = 4.0 / 3.0 * 3.14159265358979;
    for (const char* lattice : {"cubic", "blue-noise"}) {
        const Result result = sample({"cloud.ply", "-o", "out.ply", "--volume", "--json", "--count", "1500",
                                      "--lattice", lattice, "--rest-density", "500", "--force"});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        const auto json = nlohmann::json::parse(result.out);
        EXPECT_NEAR(json["volume"], ball, 0.02 * ball);
        EXPECT_EQ(json["surface_points"], 0);
        const auto points = json["interior_points"].get<double>();
        EXPECT_NEAR(points, 1500.0, 30.0);
        EXPECT_NEAR(json["particle_mass"], 500.0 * json["volume"].get<double>() / points, 1e-9);
        const PointCloud cloud = import_point_cloud(path("out.ply"));
        EXPECT_EQ(cloud.size(), points);
        for (const glm::vec3& p : cloud.positions) {
            ASSERT_LT(glm::length(p), 1.01f);
        }
    }
    write("floor.xyz", "0 0 0\n1 0 0\n0 0 1\n1 0 1\n0.5 0 0.4\n");
    expect_one_sentence(sample({"floor.xyz", "-o", "floor.ply", "--volume"}), 2, "encloses no volume");
    EXPECT_EQ(sample({"floor.xyz", "-o", "floor.ply"}).exit_code, 0);
}

TEST_F(SampleCli, AnIntensityIsIgnoredAndThatIsTold)
{
    write("scan.xyz", "//X Y Z Intensity\n4\n0 0 0 17\n1 0 0 3\n0 0 1 5\n1 0 1 9\n");
    const Result result = sample({"scan.xyz", "-o", "out.xyz"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_TRUE(result.err.ends_with("; the fourth number of each line, an intensity, is ignored\n")) << result.err;
    EXPECT_EQ(import_point_cloud(path("out.xyz")).size(), 4u);
}

TEST_F(SampleCli, WhatLiesTooFarFromTheOriginForItsSizeIsWarnedOf)
{
    write("near.obj", "v 500 0 0\nv 501 0 0\nv 500 1 0\nf 1 2 3\n");
    write("far.obj", "v 5400000 0 0\nv 5400001 0 0\nv 5400000 1 0\nf 1 2 3\n");
    write("far.xyz", "5400000 0 0\n5400001 0 0\n5400000 1 0\n");
    EXPECT_EQ(sample({"near.obj", "-o", "near.ply"}).err, "");
    for (const std::string name : {"far.obj", "far.xyz"}) {
        const Result result = sample({name, "-o", name + ".ply", "-q"});
        EXPECT_EQ(result.exit_code, 0);
        EXPECT_TRUE(result.err.starts_with("warning: " + name + ": lies 5.4e+06 m from the origin")) << result.err;
    }
}

TEST_F(SampleCli, ACloudIsSampledAnewWhereACountASpacingOrAMethodIsGiven)
{
    write("cloud.ply", sphere_ply(1000, true));
    for (const char* method : {"random", "stratified", "blue-noise"}) {
        for (const char* count : {"300", "5000"}) {
            const auto json =
                sample_json({"cloud.ply", "-o", "out.ply", "--count", count, "--method", method, "--force"});
            EXPECT_EQ(json["surface_points"], std::stoi(count)) << method;
            const PointCloud cloud = import_point_cloud(path("out.ply"));
            ASSERT_EQ(cloud.size(), std::stoul(count));
            EXPECT_EQ(cloud.colors.size(), cloud.size());
            for (std::size_t i = 0; i < cloud.size(); ++i) {
                ASSERT_NEAR(glm::length(cloud.positions[i]), 1.0f, 0.02f);
                ASSERT_GT(glm::dot(cloud.normals[i], cloud.positions[i]), 0.97f);
            }
        }
    }
    EXPECT_EQ(sample_json({"cloud.ply", "-o", "a.ply", "--method", "random"})["surface_points"], 1000);
    EXPECT_NE(import_point_cloud(path("a.ply")).positions, import_point_cloud(path("cloud.ply")).positions);
    EXPECT_NEAR(sample_json({"cloud.ply", "-o", "b.ply", "--spacing", "0.1"})["spacing"], 0.1, 1e-4);
}

TEST_F(SampleCli, TheSeedAndNothingElseDecidesThePoints)
{
    const auto points = [&](const std::string& file, const Arguments& more) {
        Arguments arguments{"builtin:teapot", "-o", file, "--count", "20000"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(sample(arguments).exit_code, 0);
        return bytes(file);
    };
    const std::string first = points("a.ply", {});
    EXPECT_EQ(first, points("b.ply", {"--seed", "1"}));
    EXPECT_NE(first, points("c.ply", {"--seed", "2"}));
    const Result one_core = shell("taskset -c $(taskset -cp $$ | sed 's/.*: //; s/[-,].*//') \"$P\" sample "
                                  "builtin:teapot -o d.ply --count 20000");
    EXPECT_EQ(one_core.exit_code, 0) << one_core.err;
    EXPECT_EQ(first, bytes("d.ply"));
}

TEST_F(SampleCli, OneLineForAPersonAndNoneWhenAskedForJsonAlone)
{
    const Result result = sample({"builtin:cube", "-o", "new/folder/c.vtp", "--count", "100"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(result.out.starts_with("new/folder/c.vtp: 100 points on 6 m^2, 0.2449 m apart, ")) << result.out;
    EXPECT_EQ(std::ranges::count(result.out, '\n'), 1);
    EXPECT_EQ(files("new/folder"), (Arguments{"c.vtp"}));
}

TEST_F(SampleCli, WrongUsageExitsWithTwo)
{
    for (const Arguments& arguments :
         std::vector<Arguments>{{},
                                {"builtin:cube"},
                                {"-o", "x.ply"},
                                {"builtin:cube", "-o", "x.ply", "--count", "10", "--spacing", "0.1"},
                                {"builtin:cube", "-o", "x.ply", "--count", "0"},
                                {"builtin:cube", "-o", "x.ply", "--count", "-5"},
                                {"builtin:cube", "-o", "x.ply", "--count", "1e3"},
                                {"builtin:cube", "-o", "x.ply", "--count", "99999999999"},
                                {"builtin:cube", "-o", "x.ply", "--spacing", "0"},
                                {"builtin:cube", "-o", "x.ply", "--spacing", "-1"},
                                {"builtin:cube", "-o", "x.ply", "--spacing", "nan"},
                                {"builtin:cube", "-o", "x.ply", "--spacing", "inf"},
                                {"builtin:cube", "-o", "x.ply", "--volume", "--rest-density", "nan"},
                                {"builtin:cube", "-o", "x.ply", "--seed", "99999999999999999999"},
                                {"builtin:cube", "-o", ""},
                                {"builtin:cube", "-o", "x.ply", "--spacing", "1e-9"},
                                {"builtin:cube", "-o", "x.ply", "--method", "hexagonal"},
                                {"builtin:cube", "-o", "x.ply", "--method", "0"},
                                {"builtin:cube", "-o", "x.ply", "--lattice", "fcc"},
                                {"builtin:cube", "-o", "x.ply", "--volume", "--method", "random"},
                                {"builtin:cube", "-o", "x.ply", "--volume", "--rest-density", "0"},
                                {"builtin:cube", "-o", "x.ply", "--seed", "-1"},
                                {"builtin:cube", "-o", "x.ply", "--seed", "one"},
                                {"builtin:bunny", "-o", "x.ply"},
                                {"builtin:cube", "-o", "x.obj"},
                                {"builtin:cube", "-o", "x"},
                                {"builtin:cube", "-o", "."},
                                {"builtin:cube", "-o", "/dev/full"}}) {
        const Result result = sample(arguments);
        EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(arguments) << result.err;
        EXPECT_EQ(result.out, "");
        EXPECT_NE(result.err, "");
    }
    EXPECT_TRUE(files(".").empty());
}

TEST_F(SampleCli, ExistingOutputIsKeptUnlessForced)
{
    write("x.ply", "mine");
    expect_one_sentence(sample({"builtin:cube", "-o", "x.ply"}), 2, "x.ply exists: give --force");
    EXPECT_EQ(bytes("x.ply"), "mine");
    EXPECT_EQ(sample({"no_such.obj", "-o", "x.ply", "--force"}).exit_code, 2);
    EXPECT_EQ(bytes("x.ply"), "mine") << "not replaced by nothing";
    EXPECT_EQ(sample({"builtin:cube", "-o", "x.ply", "--force", "--count", "10"}).exit_code, 0);
    EXPECT_TRUE(bytes("x.ply").starts_with("ply\n"));
    EXPECT_EQ(files("."), (Arguments{"x.ply"}));
}

TEST_F(SampleCli, AFullDiskIsOneSentenceAndLeavesNoHalfFile)
{
    expect_one_sentence(shell("ulimit -f 8; exec \"$P\" sample builtin:cube -o x.ply --count 100000"), 1,
                        "cannot write x.ply: ");
    EXPECT_TRUE(files(".").empty());
}

TEST_F(SampleCli, AnUnwritablePlaceIsToldBeforeTheWork)
{
    write("file", "mine");
    fs::create_directory(path("locked"));
    fs::permissions(path("locked"), fs::perms::owner_read | fs::perms::owner_exec);
    const std::string long_name = std::string(300, 'x') + ".ply";
    std::vector<std::pair<std::string, std::string>> cases{
        {"file/x.ply", "Not a directory"},
        {"file/below/x.ply", "Not a directory"},
        {"/proc/x.ply", "No such file or directory"},
        {"new/" + long_name, "File name too long"},
        {long_name, "File name too long"},
    };
    if (geteuid() != 0) { // who may do anything
        cases.emplace_back("locked/x.ply", "Permission denied");
        cases.emplace_back("locked/below/x.ply", "Permission denied");
    }
    for (const auto& [out, reason] : cases) {
        expect_one_sentence(sample({"no_such.obj", "-o", out}), 1, fmt::format("cannot write {}: {}", out, reason));
    }
    expect_one_sentence(sample({"no_such.obj", "-o", "new/below/x.ply"}), 2, "no_such.obj");
    expect_one_sentence(sample({"no_such.obj", "-o", path("new/below/x.ply").string()}), 2, "no_such.obj");
    EXPECT_EQ(files("."), (Arguments{"file", "locked"})) << "nothing is made";
    EXPECT_TRUE(files("locked").empty());
    EXPECT_EQ(sample({"builtin:cube", "-o", "new/below/x.ply", "--count", "10"}).exit_code, 0);
    EXPECT_EQ(files("new/below"), (Arguments{"x.ply"}));
}

TEST_F(SampleCli, CtrlCLeavesNothingBehind)
{
    const pid_t child = start({"sample", "builtin:teapot", "-o", "x.xyz", "--count", "200000000"});
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    kill(child, SIGINT);
    const Result result = finish(child);
    EXPECT_EQ(result.exit_code, 130) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(files(".").empty());
}

TEST_F(SampleCli, CtrlCWhileItWritesLeavesNothingBehind)
{
    const pid_t child = start({"sample", "builtin:cube", "-o", "x.xyz", "--count", "5000000"});
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (files(".").empty() && std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    kill(child, SIGINT);
    const Result result = finish(child);
    EXPECT_EQ(result.exit_code, 130) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find("interrupted, x.xyz is not written"), std::string::npos) << result.err;
    EXPECT_TRUE(files(".").empty()) << fmt::format("{}", fmt::join(files("."), " "));
}

// --- bad files: one sentence, exit code 2, little memory, little time
// --------------------------------------------------

struct BadFile {
    std::string name;
    std::string content;
};

// The address sanitizer takes more address space than there is memory.
#if !defined(__SANITIZE_ADDRESS__) && defined(__has_feature)
#if __has_feature(address_sanitizer)
#define MELTPOINT_TEST_ADDRESS_SANITIZER
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(MELTPOINT_TEST_ADDRESS_SANITIZER)
constexpr const char* LIMIT = "";
#else
constexpr const char* LIMIT = "ulimit -v 1500000; "; // KiB
#endif

/// Every way to be broken that a format knows.
std::vector<BadFile> bad_files()
{
    using namespace test; // NOLINT(google-build-using-namespace)
    const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
        return text.replace(text.find(from), from.size(), to);
    };
    const TriangleMesh cube = builtin_mesh("cube");
    TriangleMesh nan = cube;
    nan.positions[2].x = std::numeric_limits<float>::quiet_NaN();
    TriangleMesh infinite = cube;
    infinite.positions[2].x = std::numeric_limits<float>::infinity();
    TriangleMesh outside = cube;
    outside.triangles[3].z = 1000;
    TriangleMesh flat = cube;
    for (glm::vec3& p : flat.positions) {
        p.y = p.z = 0.0f;
    }
    TriangleMesh empty = cube;
    empty.triangles.clear();

    std::vector<BadFile> all;
    std::string junk;
    for (int i = 0; i < 3000; ++i) {
        junk += static_cast<char>(i * i * 31 + i * 7 + (i >> 3));
    }
    for (const char* name : {"m.obj", "m.ply", "m.stl", "m.gltf", "m.glb", "m.off", "m.xyz"}) {
        all.push_back({name, ""});
        all.push_back({name, "\n"});
        all.push_back({name, junk});
        all.push_back({name, std::string(100'000, '\0')});
        all.push_back({name, std::string(100'000, '[')});
        all.push_back({name, "<html><body>404</body></html>\n"});
    }
    const auto add = [&](const std::string& name, const auto& write) {
        for (const TriangleMesh* mesh : {&nan, &infinite, &outside, &flat, &empty}) {
            const bool is_cloud = mesh == &empty && name == "m.ply"; // no faces, eight points
            if ((mesh != &outside || !name.ends_with(".stl")) && !is_cloud) {
                all.push_back({name, write(*mesh)});
            }
        }
        const std::string whole = write(cube);
        if (name != "m.obj") { // whose lines make sense alone
            all.push_back({name, whole.substr(0, whole.size() / 2)});
            all.push_back({name, whole.substr(0, whole.size() * 9 / 10)});
        }
        all.push_back({"m.3ds", whole});
        all.push_back({"m", whole});
        all.push_back({name == "m.stl" ? "m.ply" : "m.stl", whole});
    };
    add("m.obj", obj_of);
    add("m.ply", ascii_ply_of);
    add("m.ply", [](const TriangleMesh& mesh) { return binary_ply_of(mesh, ByteOrder::Little); });
    add("m.ply", [](const TriangleMesh& mesh) { return binary_ply_of(mesh, ByteOrder::Big); });
    add("m.stl", ascii_stl_of);
    add("m.stl", binary_stl_of);
    add("m.gltf", [](const TriangleMesh& mesh) { return gltf_of(mesh); });
    add("m.glb", [](const TriangleMesh& mesh) { return glb_of(mesh); });
    add("m.off", off_of);

    for (const char* huge : {"4294967295", "9007199254740000"}) {
        all.push_back({"m.ply", replaced(ascii_ply_of(cube), "vertex 8", std::string("vertex ") + huge)});
        all.push_back(
            {"m.ply", replaced(binary_ply_of(cube, ByteOrder::Little), "face 12", std::string("face ") + huge)});
        all.push_back({"m.ply", replaced(ascii_ply_of(cube), "element face 12", std::string("element x ") + huge)});
        all.push_back({"m.off", replaced(off_of(cube), "8 12 0", std::string(huge) + " 12 0")});
        all.push_back({"m.off", replaced(off_of(cube), "8 12 0", std::string("8 ") + huge + " 0")});
        all.push_back({"m.gltf", replaced(gltf_of(cube), "\"count\": 8", std::string("\"count\": ") + huge)});
        all.push_back(
            {"m.gltf", replaced(gltf_of(cube), "\"byteLength\": 240", std::string("\"byteLength\": ") + huge)});
        all.push_back({"m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 " + std::string(huge) + "\n"});
    }
    std::string stl = binary_stl_of(cube);
    stl.replace(80, 4, "\xff\xff\xff\xff");
    all.push_back({"m.stl", stl});
    std::string list = binary_ply_of(cube, ByteOrder::Little);
    list = replaced(list, "list uchar", "list uint");
    all.push_back({"m.ply", list});

    std::string deep;
    for (int i = 0; i < 100'000; ++i) {
        deep += fmt::format(R"({{"children": [{}]}}, )", i + 1);
    }
    all.push_back({"m.glb", glb_of(cube, deep + R"({"mesh": 0})")});
    all.push_back({"m.gltf", gltf_of(cube, R"({"children": [0], "mesh": 0})")});
    all.push_back({"m.gltf", gltf_of(cube, R"({"name": "no mesh"})")});
    all.push_back({"m.gltf", gltf_json_of(cube, R"("uri": "../../../../etc/passwd", )")});
    all.push_back({"m.xyz", "1 2 3\nnan 0 0\n"});
    all.push_back({"m.xyz", "1 2 3\n1 2\n"});
    all.push_back({"m.xyz", "1 2 3\n"});
    all.push_back({"m.xyz", "1 2 3\n4 5 6\n1 2 3\n"});
    all.push_back({"m.xyz", "0 0 0\n1 0 0\n2 0 0\n3 0 0\n5 0 0\n"});
    all.push_back({"m.xyz", "0 0 0\n1e-12 0 0\n0 1e-12 0\n"});
    all.push_back({"m.xyz", "0 0 0\n1e10 0 0\n0 1e10 0\n"});
    const std::string cloud = ascii_ply_of({cube.positions, {}, {}});
    all.push_back({"m.ply", replaced(cloud, "vertex 8", "vertex 0")});
    all.push_back({"m.ply", replaced(cloud, "vertex 8", "vertex 900")});
    all.push_back({"m.ply", cloud.substr(0, cloud.size() - 9)});
    return all;
}

TEST_F(SampleCli, BadFilesAreOneSentenceEach)
{
    const std::vector<BadFile> all = bad_files();
    EXPECT_GT(all.size(), 100u);
    for (std::size_t i = 0; i < all.size(); ++i) {
        SCOPED_TRACE(fmt::format("bad file {}: {}, {} bytes: {}", i, all[i].name, all[i].content.size(),
                                 testing::PrintToString(all[i].content.substr(0, 60))));
        write(all[i].name, all[i].content);
        const auto start = std::chrono::steady_clock::now();
        const Result result = shell(LIMIT + ("exec \"$P\" sample " + all[i].name) + " -o out.ply");
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
        expect_one_sentence(result, 2, all[i].name + ":");
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
        EXPECT_LT(result.err.size(), 500u) << result.err;
        EXPECT_EQ(files("."), (Arguments{all[i].name}));
        fs::remove(path(all[i].name));
    }
}

TEST_F(SampleCli, WhatIsNoFileIsOneSentence)
{
    for (const std::string name : {"missing.obj", "missing.ply", "missing.xyz", "missing.glb", "missing"}) {
        expect_one_sentence(sample({name, "-o", "out.ply"}), 2, name + ": there is no such file");
    }
    fs::create_directory(path("folder.stl"));
    expect_one_sentence(sample({"folder.stl", "-o", "out.ply"}), 2, "folder.stl: this is a directory");
    ASSERT_EQ(mkfifo(path("pipe.ply").c_str(), 0600), 0);
    expect_one_sentence(sample({"pipe.ply", "-o", "out.ply"}), 2, "pipe.ply: this is not a regular file");
    EXPECT_EQ(shell("truncate --size 3G big.stl").exit_code, 0);
    expect_one_sentence(sample({"big.stl", "-o", "out.ply"}), 2, "at most 2147483648 are supported");
    EXPECT_FALSE(fs::exists(path("out.ply")));
}

} // namespace
} // namespace meltpoint
