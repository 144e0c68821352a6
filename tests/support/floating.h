#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run/start_scene.h"
#include "scene/scene_file.h"

namespace meltpoint {

/// A cube of ice in a basin.
struct Floating {
    const char* solver;
    double edge;  // of the cube, spacings
    int depth;    // of the water, spacings
    int width;    // of the basin, spacings
    double start; // what of the edge is under water at first
    double seconds;
    double settled; // s, from which on the mean is taken: a whole number of periods, or it would be that of a swing
    double density = 917.0; // kg/m^3, of the cube
    bool melts = false;     // to water, in water that is warm enough, as soon as heat is let go
};

inline constexpr double floating_spacing = 0.02; // m

inline std::string basin(const Floating& its)
{
    const double width = its.width * floating_spacing;
    const double depth = its.depth * floating_spacing;
    const double edge = its.edge * floating_spacing;
    const double bottom = depth - its.start * edge;
    const double side = 0.5 * (width - edge);
    const std::string ice = its.melts ? "rest_density = 1000\nsolid_density = 917\nmelts = true\ntemperature = 0"
                                      : fmt::format("rest_density = {}", its.density);
    std::string text = fmt::format(R"(
solver = "{}"
domain = {{ min = [0, 0, 0], max = [{}, {}, {}] }}
particles = {{ spacing = {}, support_ratio = 2 }}
[[solid]]
shape = "block"
min = [{}, {}, {}]
max = [{}, {}, {}]
{}
viscosity = 1
anchor = "none"
)",
                                   its.solver, width, depth + edge, width, floating_spacing, side, bottom, side,
                                   side + edge, bottom + edge, side + edge, ice);
    // Water around it, on the lattice of its spacing: below, at four sides, and above.
    const auto on_lattice = [](double length) {
        return floating_spacing * std::floor(length / floating_spacing + 1e-6);
    };
    const double low = on_lattice(bottom);
    const double near = on_lattice(side);
    const double far = width - near;
    const double top = -on_lattice(-(bottom + edge));
    std::vector<std::array<double, 6>> blocks = {{0, 0, 0, width, low, width},
                                                 {0, low, 0, near, depth, width},
                                                 {far, low, 0, width, depth, width},
                                                 {near, low, 0, far, depth, near},
                                                 {near, low, far, far, depth, width}};
    if (depth - top > 0.5 * floating_spacing) {
        blocks.push_back({near, top, near, far, depth, far});
    }
    for (const auto& block : blocks) {
        text += fmt::format(R"(
[[fluid]]
shape = "block"
min = [{}, {}, {}]
max = [{}, {}, {}]
viscosity = 1
{}
)",
                            block[0], block[1], block[2], block[3], block[4], block[5],
                            its.melts ? "temperature = 60" : "");
    }
    return text;
}

/// The mass of the water that the cube displaces over its own, mean over the time after it has settled. The level is
/// that of the volume of water and what of the cube is below it.
inline double displaced_share(const gpu::Context& context, const Floating& its)
{
    StartedScene started = start_scene(context, parse_scene(basin(its), "basin", ".", {}));
    sim::Simulation& simulation = *started.simulation;
    EXPECT_EQ(simulation.fragments()->bodies(), 1u);
    EXPECT_NEAR(static_cast<double>(simulation.fragments()->download_bodies().at(0).mass),
                its.density * std::pow(its.edge * floating_spacing, 3), 1e-4);
    const double mass = its.density * std::pow(its.edge * floating_spacing, 3);
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

/// m, the height of the water, away from the cube in the middle: of the highest particle in each square that is a
/// spacing wide, on average.
inline double water_level(const ParticleSet& now, const Floating& its)
{
    std::vector<double> top(static_cast<std::size_t>(its.width * its.width), 0.0);
    const double half_cube = 0.5 * its.edge + 2.0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const glm::dvec3 x = glm::dvec3(now.position[i]) / floating_spacing;
        const glm::dvec2 from_middle = glm::abs(glm::dvec2(x.x, x.z) - 0.5 * its.width);
        if (shared::particle_state(now.attributes[i]) == shared::STATE_FLUID &&
            std::max(from_middle.x, from_middle.y) > half_cube) {
            const auto square = static_cast<std::size_t>(std::min(static_cast<int>(x.x), its.width - 1)) +
                                static_cast<std::size_t>(std::min(static_cast<int>(x.z), its.width - 1) * its.width);
            top[square] = std::max(top[square], x.y + 0.5);
        }
    }
    double sum = 0.0;
    int squares = 0;
    for (const double each : top) {
        sum += each;
        squares += each > 0.0 ? 1 : 0;
    }
    return floating_spacing * sum / squares;
}

/// The mean of that over the next `seconds`.
inline double mean_level(sim::Simulation& simulation, const Floating& its, double seconds)
{
    constexpr int samples = 20;
    double sum = 0.0;
    for (int i = 0; i < samples; ++i) {
        simulation.advance_by(seconds / samples);
        sum += water_level(simulation.download(), its);
    }
    return sum / samples;
}

/// The level of the water after the ice has melted, over that with the ice afloat.
inline double level_after_melting(const gpu::Context& context, const Floating& its)
{
    // Heat goes so fast that it has all gone over when the water has come to rest again.
    Scene scene = parse_scene(basin(its), "basin", ".", {});
    const auto run = [&](double time_scale) {
        scene.heat.air_transfer = 0.0f;
        scene.heat.sun = 0.0f;
        scene.heat.time_scale = static_cast<float>(time_scale);
        return start_scene(context, scene);
    };
    StartedScene cold = run(1.0);
    cold.simulation->advance_by(its.settled);
    const double before = mean_level(*cold.simulation, its, its.seconds - its.settled);
    StartedScene warm = run(1e5 * std::pow(its.edge / 10.0, 2.0));
    warm.simulation->advance_by(its.seconds);
    const ParticleSet melted = warm.simulation->download();
    EXPECT_TRUE(std::ranges::all_of(
        melted.attributes, [](std::uint32_t each) { return shared::particle_state(each) == shared::STATE_FLUID; }));
    return mean_level(*warm.simulation, its, its.seconds - its.settled) / before;
}

} // namespace meltpoint
