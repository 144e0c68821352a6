#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "gpu/context.h"
#include "run/start_scene.h"
#include "scene/scene_file.h"

namespace meltpoint {

/// All that makes particles change their state, in one small box.
inline constexpr std::string_view all_drivers = R"(
solver = "dfsph"
domain = { min = [0, 0, 0], max = [1.2, 0.8, 0.8] }
particles = { spacing = 0.04 }
heat = { time_scale = 30000, air_temperature = 30 }
wind = { friction_velocity = 0.5, hop_length = 0.2, time_scale = 3000 }
dust = { life = 0.7, wind = [0.8, 0.2, 0] }
time = { frames = 2000 }
[[fluid]]
shape = "block"
min = [0, 0, 0]
max = [0.2, 0.2, 0.8]
viscosity = 0.1
[[solid]] # melts, and flow carries it off
shape = "block"
min = [0.28, 0, 0.2]
max = [0.6, 0.28, 0.52]
liquid = "water"
viscosity = 0.1
melts = true
erodes = true
erosion_threshold = 0.5
erosion_rate = 20
[[solid]] # crumbles
shape = "block"
min = [0.72, 0, 0.08]
max = [0.96, 0.24, 0.32]
becomes = "dust"
dissolve_speed = 0.2
dissolve_roughness = 0.05
[[solid]] # dissolves
shape = "sphere"
center = [0.84, 0.15, 0.6]
radius = 0.14
viscosity = 2
dissolve_speed = 0.15
dissolve_start = 0.2
[[solid]] # sand
shape = "block"
min = [0.28, 0, 0.6]
max = [0.6, 0.2, 0.8]
rest_density = 1600
wind_erodes = true
[[emitter]]
shape = "jet"
center = [0.1, 0.6, 0.4]
radius = 0.07
velocity = [1.5, 0, 0]
particles = 300
[[emitter]]
shape = "rain"
min = [0.1, 0.75, 0.1]
max = [1.1, 0.75, 0.7]
rate = 20
velocity = [0, -2, 0]
particles = 100
[[sink]]
shape = "block"
min = [1.04, 0, 0]
max = [1.2, 0.3, 0.8]
)";

/// Runs `steps` steps of it and keeps books: whoever is there was there, or came, and has not gone; ids are those of
/// the start, masses stay, and all is finite.
inline void expect_exact_books(const gpu::Context& context, std::uint32_t steps, std::uint32_t steps_a_look)
{
    StartedScene started = start_scene(context, parse_scene(all_drivers, "all_drivers", ".", {}));
    sim::Simulation& simulation = *started.simulation;
    const ParticleSet start = simulation.download();
    const auto living = [](const ParticleSet& set) {
        return static_cast<std::uint64_t>(std::ranges::count_if(
            set.attributes, [](std::uint32_t each) { return shared::particle_state(each) != shared::STATE_DEAD; }));
    };
    const auto solids = [](const ParticleSet& set) {
        return static_cast<std::uint64_t>(std::ranges::count_if(
            set.attributes, [](std::uint32_t each) { return shared::particle_state(each) == shared::STATE_SOLID; }));
    };
    const std::uint64_t initial = living(start);
    std::uint64_t left = solids(start);
    while (simulation.step() < steps) {
        simulation.advance(steps_a_look);
        const ParticleSet now = simulation.download();
        const shared::Ledger books = simulation.ledger();
        ASSERT_EQ(living(now), initial + books.emitted - books.sunk) << "after " << simulation.step() << " steps";
        ASSERT_EQ(now.id, start.id);
        ASSERT_EQ(now.mass, start.mass);
        for (std::size_t i = 0; i < now.size(); ++i) {
            ASSERT_TRUE(std::isfinite(glm::length(now.position[i])) && std::isfinite(glm::length(now.velocity[i])));
        }
        left = solids(now);
    }
    EXPECT_LT(left, solids(start) * 4 / 5);
    EXPECT_GT(simulation.picked_up(), 0.0);
    EXPECT_GT(simulation.deposited(), 0u);
    ASSERT_NE(simulation.fragments(), nullptr);
    EXPECT_GT(simulation.ledger().emitted, steps / 10);
    EXPECT_GT(simulation.ledger().sunk, steps / 20);
}

} // namespace meltpoint
