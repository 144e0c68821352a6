// A loose block in water sinks in as deep as Archimedes has it: it displaces its weight.
#include "support/floating.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class FloatingTest : public GpuTest {};

TEST_F(FloatingTest, ASmallCubeDisplacesItsWeight)
{
    for (const char* solver : {"wcsph", "dfsph"}) {
        const double share = displaced_share(
            context(),
            {.solver = solver, .edge = 10, .depth = 15, .width = 20, .start = 0.9, .seconds = 1.86, .settled = 0.93});
        SCOPED_TRACE(share);
        RecordProperty(solver, std::to_string(share));
        EXPECT_NEAR(share, 1.0, 0.05) << solver;
    }
}

TEST_F(FloatingTest, ASmallCubeMeltsAndTheLevelStays)
{
    // Water that kept the volume of ice would rise by 1.2 %.
    const double level = level_after_melting(context(), {.solver = "dfsph",
                                                         .edge = 10.293, // ten particles of ice
                                                         .depth = 20,
                                                         .width = 20,
                                                         .start = 0.917,
                                                         .seconds = 2.0,
                                                         .settled = 1.0,
                                                         .melts = true});
    RecordProperty("level", std::to_string(level));
    EXPECT_NEAR(level, 1.0, 0.007);
}

TEST_F(FloatingTest, ALightCubeRisesAndFloats)
{
    // The water that it has to push aside is ten times as heavy as the cube.
    for (const char* solver : {"dfsph", "pbf"}) {
        const Floating its{.solver = solver,
                           .edge = 8,
                           .depth = 20,
                           .width = 20,
                           .start = 2.0, // its own height under water
                           .seconds = 1.2,
                           .settled = 0.9,
                           .density = 100.0};
        StartedScene started = start_scene(context(), parse_scene(basin(its), "basin", ".", {}));
        sim::Simulation& simulation = *started.simulation;
        double highest = 0.0;
        while (simulation.time() < its.seconds) {
            simulation.advance_by(0.05);
            const shared::Body body = simulation.fragments()->download_bodies().at(0);
            highest = std::max(highest, static_cast<double>(body.center.y) / floating_spacing);
            if (simulation.time() > its.settled) { // it floats, a tenth under water, and swings
                EXPECT_NEAR(static_cast<double>(body.center.y) / floating_spacing, 21.5, 2.5)
                    << solver << " at " << simulation.time();
            }
        }
        RecordProperty(std::string(solver) + "_highest", std::to_string(highest));
        EXPECT_LT(highest, 20.0 + 8.0) << solver; // its own way down, as an arrow with friction: not farther
    }
}

// Steps as long as the water's depth alone would allow let it bounce, ever higher.
TEST_F(FloatingTest, AHeavySlabFromWallToWallStaysOnItsWater)
{
    StartedScene started = start_scene(context(), parse_scene(R"(
solver = "dfsph"
domain = { min = [0, 0, 0], max = [0.4, 1.2, 0.4], dimensions = 2 }
particles = { spacing = 0.02, support_ratio = 2 }
[[fluid]]
shape = "block"
min = [0, 0, 0]
max = [0.4, 0.4, 0]
viscosity = 1
[[solid]]
shape = "block"
min = [0, 0.4, 0]
max = [0.4, 0.8, 0]
rest_density = 8000
anchor = "none"
)",
                                                              "slab", ".", {}));
    sim::Simulation& simulation = *started.simulation;
    while (simulation.time() < 0.8) {
        simulation.advance_by(0.05);
        EXPECT_NEAR(simulation.fragments()->download_bodies().at(0).center.y, 0.6f, 0.02f) << simulation.time();
    }
}

} // namespace
} // namespace meltpoint
