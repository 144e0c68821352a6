// Solids that sun and air melt, and fluid that freezes to them: against the twins, and against what heat balance says.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/random.h"
#include "reference/cells.h"
#include "reference/erosion.h"
#include "reference/exposure.h"
#include "reference/heat.h"
#include "reference/melting.h"
#include "reference/visibility.h"
#include "sim/visibility.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

constexpr double particle_mass = 1000.0 * 0.05 * 0.05 * 0.05;
constexpr double latent_heat = 334e3;

class MeltingTest : public GpuTest {
protected:
    static sim::SimulationSettings settings(std::uint32_t solver = shared::SOLVER_WCSPH)
    {
        sim::SimulationSettings settings = test_settings(shared::KERNEL_WENDLAND);
        settings.options.solver = solver;
        settings.options.still = true;
        settings.params.dt = 1e-3f;
        settings.melting.emplace();
        for (int material = 0; material < 2; ++material) {
            settings.melting->heat.of[material] = {.solid_conductivity = 2.2f,
                                                   .fluid_conductivity = 0.6f,
                                                   .solid_specific_heat = 2100.0f,
                                                   .fluid_specific_heat = 4186.0f,
                                                   .latent_heat = static_cast<float>(latent_heat),
                                                   .melting_point = 0.0f};
            settings.melting->params.absorptivity[material] = 0.7f;
            settings.melting->params.melts[material] = 1;
        }
        settings.melting->params.sun_direction = {0.0f, -1.0f, 0.0f};
        return settings;
    }

    static void add_block(ParticleSet& set, const glm::ivec3& count, const glm::vec3& corner, std::uint32_t state)
    {
        for (int i = 0; i < count.x * count.y * count.z; ++i) {
            const glm::vec3 cell(i % count.x, i / count.x % count.y, i / (count.x * count.y));
            add_particle(set, corner + test_spacing * (cell + 0.5f));
            set.attributes.back() = shared::pack_attributes(state, 0);
        }
        set.release_time.assign(set.size(), std::numeric_limits<float>::infinity());
    }

    static std::size_t count(const ParticleSet& set, std::uint32_t state)
    {
        return static_cast<std::size_t>(std::ranges::count_if(
            set.attributes, [&](std::uint32_t each) { return shared::particle_state(each) == state; }));
    }

    /// A settings' sun alone, which takes what it melts away.
    static sim::SimulationSettings shining(double power)
    {
        sim::SimulationSettings its = settings();
        its.params.gravity = glm::vec3(0.0f);
        its.melting->params.sun = static_cast<float>(power);
        its.emission.sinks.push_back(
            {.low = {-1.0f, -1.0f, -1.0f}, .shape = shared::SINK_BLOCK, .high = {2.0f, 2.0f, 2.0f}});
        return its;
    }

    /// The same for air: heat that comes from everywhere, and as much wherever a surface is.
    static sim::SimulationSettings in_warm_air(double power)
    {
        sim::SimulationSettings its = shining(0.0);
        its.melting->params.air_temperature = 20.0f;
        its.melting->params.air_transfer = static_cast<float>(power / 20.0);
        return its;
    }
};

TEST_F(MeltingTest, LooksAreTheTwins)
{
    sim::SimulationSettings its = settings();
    its.params.dt = 2e-4f;
    its.melting->params.sun = 4e7f;
    its.melting->params.sun_direction = glm::normalize(glm::vec3(0.5f, -1.0f, 0.2f));
    its.melting->params.air_temperature = 80.0f;
    its.melting->params.air_transfer = 3e4f;
    its.melting->time_scale = 40.0;
    ParticleSet start;
    add_block(start, {8, 6, 8}, glm::vec3(0.2f, 0.0f, 0.3f), shared::STATE_SOLID);
    add_block(start, {3, 4, 8}, glm::vec3(0.2f, 0.35f, 0.3f), shared::STATE_SOLID); // its shadow
    add_block(start, {3, 3, 8}, glm::vec3(0.45f, 0.3f, 0.3f), shared::STATE_FLUID); // on it
    add_block(start, {5, 1, 1}, glm::vec3(0.0f), shared::STATE_DEAD);               // an emitter's slots
    its.melting->params.birth_enthalpy[0] = 4e5f;
    Random random(12);
    for (std::size_t i = 0; i < start.size(); ++i) {
        const bool solid = shared::particle_state(start.attributes[i]) == shared::STATE_SOLID;
        start.weight[i] =
            solid ? 0.8f + 0.5f * static_cast<float>(random.uniform()) : start.weight[i]; // of any density
        its.melting->enthalpy.push_back(solid ? latent_heat * (1.1 * random.uniform() - 0.1)
                                              : latent_heat * (1.2 * random.uniform() - 0.3));
    }
    sim::Simulation simulation(context(), start, its);
    const reference::Settings twin_settings{.kernel = its.options.kernel, .params = simulation.params()};
    const shared::VisibilityParams map_params =
        sim::visibility_params({.direction = its.melting->params.sun_direction}, simulation.params());
    std::vector<double> enthalpy_at_last_look = its.melting->enthalpy;
    double looked_at = 0.0;
    double largest_change = 0.0;
    std::size_t melted = 0;
    std::size_t frozen = 0;
    for (int look = 0; look < 16; ++look) {
        const ParticleSet before = simulation.download();
        std::vector<double> enthalpy = simulation.enthalpy();
        const std::vector<double> enthalpy_before = enthalpy;
        reference::State twin = reference::from_particle_set(before);
        const double seconds = (simulation.time() - looked_at) * its.melting->time_scale;
        looked_at = simulation.time();
        const auto exposure = reference::exposure(twin_settings, twin);
        const auto seen =
            reference::visibility_of_solids(map_params, reference::depth_map(map_params, twin), twin, exposure);
        reference::warm(twin_settings, its.melting->heat, its.melting->params, twin, exposure, seen, enthalpy, seconds);
        reference::conduct(twin_settings, its.melting->heat, twin,
                           reference::find_neighbors(simulation.params(), twin.position), enthalpy, seconds);
        frozen += reference::freeze(twin_settings, twin, enthalpy);

        ASSERT_EQ(simulation.steps_until_erosion(), 0u);
        simulation.advance(1);
        melted += reference::melt(
            its.melting->heat, its.melting->params, twin, enthalpy, enthalpy_at_last_look,
            seconds > 0.0 ? 0.5 * seconds_between_looks(simulation) * its.melting->time_scale / seconds : 0.0);
        const ParticleSet after = simulation.download();
        const std::vector<double> found = simulation.enthalpy();
        for (std::size_t i = 0; i < after.size(); ++i) {
            largest_change = std::max(largest_change, std::abs(enthalpy[i] - enthalpy_before[i]));
            ASSERT_EQ(after.attributes[i], twin.attributes[i]) << "particle " << i << " at look " << look;
            // A texel's edge may be a particle's: the map shows it to one and not to the other.
            ASSERT_NEAR(found[i], enthalpy[i], 1e-4 * largest_change) << "particle " << i << " at look " << look;
            const bool stops = shared::particle_state(twin.attributes[i]) == shared::STATE_SOLID;
            ASSERT_TRUE(!stops || after.velocity[i] == glm::vec3(0.0f));
        }
        simulation.advance(simulation.steps_until_erosion());
    }
    EXPECT_GT(melted, 5u);
    EXPECT_GT(frozen, 3u);
    EXPECT_GT(largest_change, 0.005 * latent_heat);
}

TEST_F(MeltingTest, TheSunMeltsWhatItsPowerAmountsTo)
{
    // A slab that fills the box from side to side: front speed = power / (density latent heat).
    constexpr double power = 0.7 * 8e7;
    const double speed = power / (1000.0 * latent_heat);
    for (const double disorder : {0.0, 0.1}) { // spacings
        ParticleSet start;
        add_block(start, {20, 14, 20}, glm::vec3(0.0f), shared::STATE_SOLID);
        Random random(3);
        for (glm::vec3& x : start.position) {
            x += static_cast<float>(disorder) * test_spacing * random_vector(random);
        }
        sim::SimulationSettings its = shining(power / 0.7);
        its.melting->enthalpy.assign(start.size(), 0.0);
        its.melting->heat.of[0].solid_conductivity = its.melting->heat.of[0].fluid_conductivity = 1.0f;
        sim::Simulation simulation(context(), start, its);
        double times[2] = {0.0, 0.0};
        const std::size_t layer = 400;
        while (simulation.time() < 5.0 && times[1] == 0.0) {
            simulation.advance(4);
            const std::size_t left = count(simulation.download(), shared::STATE_SOLID);
            times[0] = times[0] == 0.0 && left <= 12 * layer ? simulation.time() : times[0];
            times[1] = left <= 4 * layer ? simulation.time() : 0.0;
        }
        const double found = 8.0 * static_cast<double>(test_spacing) / (times[1] - times[0]);
        EXPECT_NEAR(found / speed, 1.0, disorder == 0.0 ? 0.03 : 0.06);
    }
}

TEST_F(MeltingTest, ABallMeltsInwardAtTheSpeedOfItsHeat)
{
    constexpr double power = 3e8;
    const double speed = power / (1000.0 * latent_heat);
    constexpr double radius = 11.5 * 0.05;
    ParticleSet start;
    for (int i = 0; i < 24 * 24 * 24; ++i) {
        const glm::vec3 x = test_spacing * (glm::vec3(i % 24, i / 24 % 24, i / 576) - 1.5f);
        if (glm::distance(x, glm::vec3(0.5f)) < static_cast<float>(radius)) {
            add_particle(start, x);
            start.attributes.back() = shared::pack_attributes(shared::STATE_SOLID, 0);
        }
    }
    start.release_time.assign(start.size(), std::numeric_limits<float>::infinity());
    sim::SimulationSettings its = in_warm_air(power);
    its.params.domain_min = glm::vec3(-0.2f);
    its.params.domain_max = glm::vec3(1.2f);
    its.melting->enthalpy.assign(start.size(), 0.0);
    sim::Simulation simulation(context(), start, its);
    // Radii of the balls of the volume that is left.
    const auto radius_left = [&] {
        const auto left = static_cast<double>(count(simulation.download(), shared::STATE_SOLID));
        return std::cbrt(left * std::pow(static_cast<double>(test_spacing), 3) * 3.0 / (4.0 * std::numbers::pi));
    };
    double times[2] = {0.0, 0.0};
    double radii[2] = {0.0, 0.0};
    while (simulation.time() < 1.5 && times[1] == 0.0) {
        simulation.advance(4);
        const double now = radius_left();
        if (times[0] == 0.0 && now < 0.9 * radius) {
            times[0] = simulation.time();
            radii[0] = now;
        }
        if (now < 0.5 * radius) {
            times[1] = simulation.time();
            radii[1] = now;
        }
    }
    EXPECT_NEAR((radii[0] - radii[1]) / (times[1] - times[0]) / speed, 1.0, 0.12);
}

TEST_F(MeltingTest, NoHeatIsLostWhereNoneComesOrGoes)
{
    sim::SimulationSettings its = settings(shared::SOLVER_DFSPH);
    its.melting->time_scale = 4e5;
    ParticleSet start; // ice in warm water
    add_block(start, {6, 6, 6}, glm::vec3(0.35f, 0.0f, 0.35f), shared::STATE_SOLID);
    add_block(start, {20, 6, 7}, glm::vec3(0.0f, 0.0f, 0.65f), shared::STATE_FLUID);
    double sum = 0.0;
    for (const std::uint32_t each : start.attributes) {
        const bool solid = shared::particle_state(each) == shared::STATE_SOLID;
        its.melting->enthalpy.push_back(solid ? -2100.0 * 5.0 : latent_heat + 4186.0 * 60.0);
        sum += its.melting->enthalpy.back();
    }
    sim::Simulation simulation(context(), start, its);
    simulation.advance(300);
    double now = 0.0;
    for (const double each : simulation.enthalpy()) {
        now += each;
    }
    EXPECT_NEAR(now / sum, 1.0, 1e-5);
    const ParticleSet found = simulation.download();
    EXPECT_GT(count(found, shared::STATE_FLUID), 850u); // and some of the ice has melted
    EXPECT_LT(count(found, shared::STATE_FLUID), 1056u);
}

TEST_F(MeltingTest, WaterFreezesToAColdPlateAndNowhereElse)
{
    sim::SimulationSettings its = settings(shared::SOLVER_DFSPH);
    its.melting->time_scale = 5e5;
    its.melting->heat.of[1] = {.solid_conductivity = 50.0f,
                               .fluid_conductivity = 50.0f,
                               .solid_specific_heat = 1.0f,
                               .fluid_specific_heat = 1.0f};
    ParticleSet start;
    add_block(start, {20, 7, 20}, glm::vec3(0.0f, 0.075f, 0.0f), shared::STATE_FLUID);
    its.melting->enthalpy.assign(start.size(), latent_heat);
    for (int i = 0; i < 400; ++i) {
        add_particle(start, test_spacing * (glm::vec3(i % 20, 0.0f, i / 20) + 0.5f));
        start.attributes.back() = shared::pack_attributes(shared::STATE_COLLIDER, 1);
        start.mass.back() = 0.0f;
        its.melting->enthalpy.push_back(-60.0);
    }
    start.release_time.assign(start.size(), 0.0f); // as of water that was ice, or came out of an emitter
    sim::Simulation simulation(context(), start, its);
    std::size_t before = 0;
    for (int portion = 0; portion < 4; ++portion) {
        simulation.advance(100);
        const ParticleSet now = simulation.download();
        const std::size_t frozen = count(now, shared::STATE_SOLID);
        EXPECT_GT(frozen, before);
        before = frozen;
        for (std::size_t i = 0; i < now.size(); ++i) {                          // a sheet that grows from the plate
            EXPECT_EQ(shared::cause_of(now.attributes[i]), shared::CAUSE_NONE); // none was freed again
            if (shared::particle_state(now.attributes[i]) == shared::STATE_SOLID) {
                EXPECT_LT(now.position[i].y, 0.05f + test_spacing * static_cast<float>(frozen) / 400.0f + 0.12f);
            }
        }
    }
    EXPECT_GT(before, 400u);
    // The plate holds its temperature.
    EXPECT_EQ(simulation.enthalpy().back(), -60.0);
}

TEST_F(MeltingTest, RerunsAreBitIdenticalInAnyPortions)
{
    sim::SimulationSettings its = settings(shared::SOLVER_DFSPH);
    its.melting->time_scale = 2e4;
    its.melting->params.sun = 2e4f;
    its.melting->params.sun_direction = glm::normalize(glm::vec3(0.5f, -1.0f, 0.2f));
    its.melting->params.air_temperature = 30.0f;
    its.melting->params.air_transfer = 50.0f;
    ParticleSet start;
    add_block(start, {8, 8, 8}, glm::vec3(0.3f, 0.0f, 0.3f), shared::STATE_SOLID);
    its.melting->enthalpy.assign(start.size(), 0.0);
    ParticleSet seen[2];
    std::vector<double> heat[2];
    for (int run = 0; run < 2; ++run) {
        sim::Simulation simulation(context(), start, its);
        for (std::uint32_t portion = 1; simulation.step() < 400; ++portion) {
            simulation.advance(
                run == 0 ? 400 : std::min(portion % 7 + 1, static_cast<std::uint32_t>(400 - simulation.step())));
        }
        seen[run] = simulation.download();
        heat[run] = simulation.enthalpy();
    }
    EXPECT_EQ(seen[0].attributes, seen[1].attributes);
    EXPECT_EQ(seen[0].position, seen[1].position);
    EXPECT_EQ(heat[0], heat[1]);
    EXPECT_GT(count(seen[0], shared::STATE_FLUID), 50u);
}

TEST_F(MeltingTest, WhatMeltsIsNotKicked)
{
    sim::SimulationSettings its = settings();
    its.params.gravity = glm::vec3(0.0f);
    its.params.dt = 2e-4f;
    its.melting->params.sun = 4e9f;
    ParticleSet start;
    add_block(start, {8, 8, 8}, glm::vec3(0.3f, 0.3f, 0.3f), shared::STATE_SOLID);
    its.melting->enthalpy.assign(start.size(), 0.95 * latent_heat);
    sim::Simulation simulation(context(), start, its);
    for (int portion = 0; portion < 30; ++portion) {
        simulation.advance(20);
        const ParticleSet now = simulation.download();
        for (const glm::vec3& v : now.velocity) {
            ASSERT_LT(glm::length(v), 0.02f * its.params.speed_of_sound);
        }
    }
    EXPECT_GT(count(simulation.download(), shared::STATE_FLUID), 100u);
}

} // namespace
} // namespace meltpoint
