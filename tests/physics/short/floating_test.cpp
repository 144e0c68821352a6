// A loose block in water sinks in as deep as Archimedes has it: it displaces its weight.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "run/start_scene.h"
#include "scene/scene_file.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

struct Floating {
    const char* solver;
    int edge;  // of the cube, spacings
    int depth; // of the water, spacings
    int width; // of the basin, spacings
    double seconds;
};

constexpr double spacing = 0.02;
constexpr double ice_density = 917.0;

std::string basin(const Floating& its)
{
    const double width = its.width * spacing;
    const double depth = its.depth * spacing;
    const double edge = its.edge * spacing;
    const double bottom = depth - 0.8 * edge; // somewhat too high
    const double side = 0.5 * (width - edge);
    std::string text = fmt::format(R"(
solver = "{}"
domain = {{ min = [0, 0, 0], max = [{}, {}, {}] }}
particles = {{ spacing = {}, support_ratio = 2 }}
[[solid]]
shape = "block"
min = [{}, {}, {}]
max = [{}, {}, {}]
rest_density = {}
anchor = "none"
)",
                                   its.solver, width, depth + edge, width, spacing, side, bottom, side, side + edge,
                                   bottom + edge, side + edge, ice_density);
    // Water around it: below, and at four sides.
    const double blocks[5][6] = {{0, 0, 0, width, bottom, width},
                                 {0, bottom, 0, side, depth, width},
                                 {side + edge, bottom, 0, width, depth, width},
                                 {side, bottom, 0, side + edge, depth, side},
                                 {side, bottom, side + edge, side + edge, depth, width}};
    for (const auto& block : blocks) {
        text += fmt::format(R"(
[[fluid]]
shape = "block"
min = [{}, {}, {}]
max = [{}, {}, {}]
viscosity = 1
)",
                            block[0], block[1], block[2], block[3], block[4], block[5]);
    }
    return text;
}

class FloatingTest : public GpuTest {
protected:
    /// The mass of the water that the cube displaces over its own, mean over the last three fifths of the time, in
    /// which it goes up and down once. The level is that of the volume of water and what of the cube is below it.
    static double displaced_share(const Floating& its)
    {
        StartedScene started = start_scene(context(), parse_scene(basin(its), "basin", ".", {}));
        sim::Simulation& simulation = *started.simulation;
        EXPECT_EQ(simulation.fragments()->bodies(), 1u);
        EXPECT_NEAR(static_cast<double>(simulation.fragments()->download_bodies().at(0).mass),
                    ice_density * std::pow(its.edge * spacing, 3), 1e-4);
        const double mass = ice_density * std::pow(its.edge * spacing, 3);
        double sum = 0.0;
        int samples = 0;
        while (simulation.time() < its.seconds) {
            simulation.advance_by(0.02);
            if (simulation.time() < 0.4 * its.seconds) {
                continue;
            }
            const ParticleSet now = simulation.download();
            double lowest = 1e9;
            std::size_t fluid = 0;
            for (std::size_t i = 0; i < now.size(); ++i) {
                const bool is_ice = shared::is_loose(now.attributes[i]);
                lowest = is_ice ? std::min(lowest, static_cast<double>(now.position[i].y)) : lowest;
                fluid += is_ice ? 0 : 1;
            }
            const double side = its.edge * spacing;
            const double area = std::pow(its.width * spacing, 2);
            const double water = static_cast<double>(fluid) * std::pow(spacing, 3);
            const double bottom = lowest - 0.5 * spacing;
            // level area = water + side^2 (level - bottom)
            const double level = (water - side * side * bottom) / (area - side * side);
            sum += 1000.0 * side * side * (level - bottom) / mass;
            ++samples;
        }
        return sum / samples;
    }
};

TEST_F(FloatingTest, ASmallCubeDisplacesItsWeight)
{
    for (const char* solver : {"wcsph", "dfsph"}) {
        const double share = displaced_share({.solver = solver, .edge = 10, .depth = 16, .width = 20, .seconds = 1.2});
        EXPECT_NEAR(share, 1.0, 0.05) << solver;
    }
}

} // namespace
} // namespace meltpoint
