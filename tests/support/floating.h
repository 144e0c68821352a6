#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run/start_scene.h"
#include "scene/scene_file.h"

namespace meltpoint {

/// A cube of ice in a basin.
struct Floating {
    const char* solver;
    int edge;  // of the cube, spacings
    int depth; // of the water, spacings
    int width; // of the basin, spacings
    double start;  // what of the edge is under water at first
    double seconds;
    double settled; // s, from which on the mean is taken: a whole number of periods, or it would be that of a swing
};

inline constexpr double floating_spacing = 0.02; // m
inline constexpr double ice_density = 917.0;     // kg/m^3

inline std::string basin(const Floating& its)
{
    const double width = its.width * floating_spacing;
    const double depth = its.depth * floating_spacing;
    const double edge = its.edge * floating_spacing;
    const double bottom = depth - its.start * edge;
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
                                   its.solver, width, depth + edge, width, floating_spacing, side, bottom, side,
                                   side + edge, bottom + edge, side + edge, ice_density);
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

/// The mass of the water that the cube displaces over its own, mean over the time after it has settled. The level is that of the volume of water and what of the cube is below it.
inline double displaced_share(const gpu::Context& context, const Floating& its)
{
    StartedScene started = start_scene(context, parse_scene(basin(its), "basin", ".", {}));
    sim::Simulation& simulation = *started.simulation;
    EXPECT_EQ(simulation.fragments()->bodies(), 1u);
    EXPECT_NEAR(static_cast<double>(simulation.fragments()->download_bodies().at(0).mass),
                ice_density * std::pow(its.edge * floating_spacing, 3), 1e-4);
    const double mass = ice_density * std::pow(its.edge * floating_spacing, 3);
    double sum = 0.0;
    int samples = 0;
    while (simulation.time() < its.seconds) {
        simulation.advance_by(0.02);
        if (simulation.time() < its.settled) {
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
        const double side = its.edge * floating_spacing;
        const double area = std::pow(its.width * floating_spacing, 2);
        const double water = static_cast<double>(fluid) * std::pow(floating_spacing, 3);
        const double bottom = lowest - 0.5 * floating_spacing;
        // level area = water + side^2 (level - bottom)
        const double level = (water - side * side * bottom) / (area - side * side);
        sum += 1000.0 * side * side * (level - bottom) / mass;
        ++samples;
    }
    return sum / samples;
}

} // namespace meltpoint
