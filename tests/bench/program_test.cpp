// `meltpoint bench` as a user meets it.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <sys/wait.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/scratch_folder.h"

namespace meltpoint {
namespace {

class Bench : public testing::Test {
protected:
    /// Exit code; its streams go to out and err.
    int run(const std::string& arguments)
    {
        const std::string line =
            "'" MELTPOINT_TEST_PROGRAM "' bench " + arguments + " >'" + path("out") + "' 2>'" + path("err") + "'";
        const int status = std::system(line.c_str());
        out_ = test::read_bytes(path("out"));
        err_ = test::read_bytes(path("err"));
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

    test::ScratchFolder folder_;
    std::string out_;
    std::string err_;
};

std::set<std::string> keys(const nlohmann::json& object)
{
    std::set<std::string> names;
    for (const auto& [name, value] : object.items()) {
        names.insert(name);
    }
    return names;
}

TEST_F(Bench, JsonHasARowForEverySizeAndTile)
{
    ASSERT_EQ(run("--particles 1000,2000 --steps 5 --warm-up 10 --tile 1,4 --json '" + path("bench.json") + "'"), 0)
        << err_;
    const nlohmann::json document = nlohmann::json::parse(test::read_bytes(path("bench.json")));
    EXPECT_FALSE(document["device"].get<std::string>().empty());
    EXPECT_FALSE(document["driver"].get<std::string>().empty());
    ASSERT_EQ(document["results"].size(), 4u);
    const int particles[] = {1000, 1000, 2000, 2000};
    const int tiles[] = {1, 4, 1, 4};
    for (std::size_t i = 0; i < 4; ++i) {
        const nlohmann::json& row = document["results"][i];
        EXPECT_EQ(keys(row),
                  (std::set<std::string>{"particles", "tile", "neighbors", "steps", "step_ms", "passes",
                                         "particle_steps_per_s", "pair_visits_per_s", "yardstick_step_ms", "speedup",
                                         "dt", "simulated_s_per_s", "density_error_mean", "iterations_density"}));
        EXPECT_EQ(row["particles"], particles[i]);
        EXPECT_EQ(row["tile"], tiles[i]);
        EXPECT_EQ(row["steps"], 5);
        const double neighbors = row["neighbors"];
        EXPECT_GT(neighbors, 20.0);
        EXPECT_LT(neighbors, 33.0);
        const double step = row["step_ms"];
        const double yardstick = row["yardstick_step_ms"];
        EXPECT_GT(step, 0.0);
        EXPECT_GT(yardstick, 0.0);
        const double rate = row["particle_steps_per_s"];
        EXPECT_NEAR(rate, particles[i] / step * 1e3, 1e-6 * rate);
        EXPECT_NEAR(row["pair_visits_per_s"].get<double>(), rate * neighbors, 1e-6 * rate * neighbors);
        EXPECT_NEAR(row["speedup"].get<double>(), yardstick / step, 1e-6 * yardstick / step);
        for (const char* pass : {"kick and drift", "cell key", "sort", "reorder", "density", "forces", "kick"}) {
            EXPECT_GT(row["passes"][pass].get<double>(), 0.0) << pass;
        }
    }
    EXPECT_EQ(document["results"][0]["neighbors"], document["results"][1]["neighbors"]); // tiles change no bit
}

TEST_F(Bench, OwnStepsAreWhatTheSceneHas)
{
    const std::string block = "--scene block_3d --steps 9 --warm-up 9 --json '" + path("bench.json") + "'";
    double at_fixed_steps = 0.0;
    for (const std::string options : {" --set solver=pbf", " --set solver=pbf --own-steps"}) {
        ASSERT_EQ(run(block + options + " --set time.dt=auto"), 0) << err_;
        const nlohmann::json row = nlohmann::json::parse(test::read_bytes(path("bench.json")))["results"][0];
        const double dt = row["dt"];
        EXPECT_NEAR(row["simulated_s_per_s"].get<double>(), dt / row["step_ms"].get<double>() * 1e3, 1e-6);
        EXPECT_GE(row["iterations_density"].get<double>(), 1.0);
        EXPECT_LT(row["density_error_mean"].get<double>(), 0.011);
        EXPECT_GT(dt, 1.01 * at_fixed_steps); // long, as nothing is fast yet
        at_fixed_steps = dt;
    }
}

TEST_F(Bench, PrintsATable)
{
    ASSERT_EQ(run("--particles 500 --steps 2 --warm-up 0"), 0) << err_;
    for (const char* word :
         {"neighbors", "ms a step", "p-steps/s", "pairs/s", "bytes", "yardstick", "density", "forces"}) {
        EXPECT_NE(out_.find(word), std::string::npos) << word << " in\n" << out_;
    }
}

TEST_F(Bench, RunsAScene)
{
    ASSERT_EQ(run("--scene drop --steps 2 --warm-up 1 --json '" + path("bench.json") + "'"), 0) << err_;
    const nlohmann::json document = nlohmann::json::parse(test::read_bytes(path("bench.json")));
    ASSERT_EQ(document["results"].size(), 1u);
    EXPECT_GT(document["results"][0]["particles"], 1000);
}

TEST_F(Bench, SolvedPressureIsMeasuredWithoutTheYardstick)
{
    std::ofstream(path("block.toml"))
        << "solver = \"dfsph\"\n[particles]\nspacing = 0.1\n[[fluid]]\nshape = \"block\"\n"
           "min = [-0.5, 0, -0.5]\nmax = [0.5, 0.5, 0.5]\n";
    ASSERT_EQ(run("--scene '" + path("block.toml") + "' --steps 2 --warm-up 1 --json '" + path("bench.json") + "'"), 0)
        << err_;
    EXPECT_NE(err_.find("weakly compressible"), std::string::npos) << err_;
    const nlohmann::json result = nlohmann::json::parse(test::read_bytes(path("bench.json")))["results"][0];
    EXPECT_GT(result["passes"]["solve density"], 0.0);
    EXPECT_TRUE(result["yardstick_step_ms"].is_null());
}

TEST_F(Bench, ASceneWithCollidersIsMeasuredWithoutTheYardstick)
{
    ASSERT_EQ(run("--scene teapot_floor --steps 1 --warm-up 0 --json '" + path("bench.json") + "'"), 0) << err_;
    EXPECT_NE(err_.find("no colliders"), std::string::npos) << err_;
    const nlohmann::json document = nlohmann::json::parse(test::read_bytes(path("bench.json")));
    ASSERT_EQ(document["results"].size(), 1u);
    EXPECT_GT(document["results"][0]["step_ms"], 0.0);
    EXPECT_TRUE(document["results"][0]["yardstick_step_ms"].is_null());
    EXPECT_TRUE(document["results"][0]["speedup"].is_null());
}

TEST_F(Bench, TheSmallestBlockFitsItsBox)
{
    EXPECT_EQ(run("--particles 65 --steps 1 --warm-up 0"), 0) << err_;
    EXPECT_EQ(run("--particles 64"), 2);
    EXPECT_NE(err_.find("not in range 65"), std::string::npos) << err_;
}

TEST_F(Bench, WrongUseIsOneSentenceAndExitsWithTwo)
{
    for (const std::string arguments :
         {"--particles 0", "--particles -5", "--particles many", "--particles 1000,x", "--particles 99999999999",
          "--steps 0", "--steps x", "--tile 0", "--tile 17", "--warm-up -1", "--scene no_such_scene",
          "--scene drop --particles 1000", "--particles 1000000000", "--device no_such_device", "--json", "surplus"}) {
        EXPECT_EQ(run(arguments), 2) << arguments << "\n" << err_;
        EXPECT_FALSE(err_.empty()) << arguments;
        EXPECT_TRUE(out_.empty()) << arguments << "\n" << out_;
    }
}

TEST_F(Bench, AFileThatCannotBeWrittenIsToldBeforeTheMeasurement)
{
    EXPECT_EQ(run("--particles 1000 --steps 1 --json '" + path("no_such_folder/bench.json") + "'"), 1);
    EXPECT_NE(err_.find("no_such_folder"), std::string::npos) << err_;
    EXPECT_TRUE(out_.empty()) << out_;
}

} // namespace
} // namespace meltpoint
