// Flow that carries solids off, and sediment that settles: against the twins, and against the law of erosion.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/random.h"
#include "reference/exposure.h"
#include "reference/hydraulic.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class HydraulicTest : public GpuTest {
protected:
    static sim::SimulationSettings settings(std::uint32_t solver = shared::SOLVER_WCSPH)
    {
        sim::SimulationSettings settings = test_settings(shared::KERNEL_WENDLAND);
        settings.options.solver = solver;
        settings.options.still = true;
        settings.params.dt = solver == shared::SOLVER_WCSPH ? 2e-4f : 1e-3f;
        settings.hydraulic.emplace();
        shared::HydraulicParams& params = settings.hydraulic->params;
        params.consistency = 1.0f;
        params.flow_exponent = 0.5f;
        params.time_scale = 1.0f;
        params.deposition_speed = 0.0f; // nothing settles
        params.deposition_time = 1.0f;
        for (int material = 0; material < 2; ++material) {
            params.erodes[material] = 1;
            params.deposits[material] = 1;
            params.threshold[material] = 1.0f;
            params.rate[material] = 20.0f;
            params.exponent[material] = 1.0f;
        }
        return settings;
    }

    static void add_block(ParticleSet& set, const glm::ivec3& count, const glm::vec3& corner, std::uint32_t state,
                          const glm::vec3& velocity = glm::vec3(0.0f))
    {
        for (int i = 0; i < count.x * count.y * count.z; ++i) {
            const glm::vec3 cell(i % count.x, i / count.x % count.y, i / (count.x * count.y));
            add_particle(set, corner + test_spacing * (cell + 0.5f), velocity);
            set.attributes.back() = shared::pack_attributes(state, state == shared::STATE_SOLID ? 0 : 1);
        }
        set.release_time.assign(set.size(), std::numeric_limits<float>::infinity());
    }

    static std::size_t count(const ParticleSet& set, std::uint32_t state)
    {
        return static_cast<std::size_t>(std::ranges::count_if(
            set.attributes, [&](std::uint32_t each) { return shared::particle_state(each) == state; }));
    }

    /// A bed of four layers from wall to wall under fluid that moves along it.
    static ParticleSet bed_under_flow(float speed)
    {
        ParticleSet start;
        add_block(start, {20, 4, 10}, glm::vec3(0.0f), shared::STATE_SOLID);
        add_block(start, {20, 5, 10}, glm::vec3(0.0f, 0.2f, 0.0f), shared::STATE_FLUID, {speed, 0.0f, 0.0f});
        return start;
    }

    /// Its box: a channel without an end.
    static void make_channel(sim::SimulationSettings& its)
    {
        its.params.domain_max.z = 0.5f;
        its.params.wall_mask = 0x3c;
        its.params.periodic_mask = 0x03;
    }

    /// The same in steps so short that its velocities stay what they are.
    static sim::SimulationSettings prescribed()
    {
        sim::SimulationSettings its = settings();
        its.params.gravity = glm::vec3(0.0f);
        its.params.dt = 1e-6f;
        make_channel(its);
        return its;
    }

    /// Pa, of such a flow.
    static double stress_of(const sim::SimulationSettings& its, double speed)
    {
        const shared::HydraulicParams& params = its.hydraulic->params;
        return static_cast<double>(params.consistency) *
               std::pow(speed / static_cast<double>(test_spacing), static_cast<double>(params.flow_exponent));
    }
};

TEST_F(HydraulicTest, LooksAreTheTwins)
{
    sim::SimulationSettings its = settings();
    its.hydraulic->params.time_scale = 40.0f;
    its.hydraulic->params.exponent[0] = 1.5f;
    its.hydraulic->params.deposition_speed = 0.6f;
    its.hydraulic->params.deposition_time = 4e-3f;
    ParticleSet start;
    add_block(start, {8, 6, 8}, glm::vec3(0.2f, 0.0f, 0.3f), shared::STATE_SOLID);
    for (std::size_t i = 0; i < start.size() / 8; ++i) {
        start.attributes[i] = shared::pack_attributes(shared::STATE_SOLID, 1);
    }
    add_block(start, {5, 6, 12}, glm::vec3(0.6f, 0.0f, 0.2f), shared::STATE_FLUID, {-2.0f, 0.0f, 1.0f});
    add_block(start, {8, 4, 8}, glm::vec3(0.2f, 0.3f, 0.3f), shared::STATE_FLUID, {3.0f, -1.0f, 0.0f});
    its.hydraulic->params.deposits[1] = 0;
    Random random(12);
    std::vector<double> strength;
    for (std::size_t i = 0; i < start.size(); ++i) {
        its.hydraulic->strength.push_back(static_cast<float>(0.5 + random.uniform()));
        strength.push_back(static_cast<double>(its.hydraulic->strength.back()));
        start.velocity[i] += shared::is_still(start.attributes[i]) ? glm::vec3(0.0f) : random_vector(random);
    }
    sim::Simulation simulation(context(), start, its);
    const reference::Settings twin_settings{.kernel = its.options.kernel, .params = simulation.params()};
    std::vector<double> rate(start.size(), 0.0);
    double looked_at = 0.0;
    std::size_t freed = 0;
    std::size_t deposited = 0;
    std::size_t halfway = 0;
    for (int look = 0; look < 40; ++look) {
        std::vector<double> damage = simulation.damage();
        reference::State twin = reference::from_particle_set(simulation.download());
        const double seconds = simulation.time() - looked_at;
        looked_at = simulation.time();
        reference::scour(twin_settings, its.hydraulic->params, twin, reference::exposure(twin_settings, twin),
                         {.strength = strength, .done = damage, .rate = rate}, seconds);
        deposited += reference::deposit(twin_settings, its.hydraulic->params, twin, damage, seconds);

        ASSERT_EQ(simulation.steps_until_erosion(), 0u);
        simulation.advance(1);
        freed += reference::detach(its.hydraulic->params, twin, {.strength = strength, .done = damage, .rate = rate},
                                   0.5 * seconds_between_looks(simulation));
        const ParticleSet after = simulation.download();
        const std::vector<double> found = simulation.damage();
        for (std::size_t i = 0; i < after.size(); ++i) {
            ASSERT_EQ(after.attributes[i], twin.attributes[i]) << "particle " << i << " at look " << look;
            ASSERT_NEAR(found[i], damage[i], 2e-6) << "particle " << i << " at look " << look;
            halfway += found[i] > 0.1 && found[i] < 0.9 ? 1 : 0;
        }
        ASSERT_EQ(simulation.deposited(), deposited);
        simulation.advance(simulation.steps_until_erosion());
    }
    EXPECT_GT(freed, 30u);
    EXPECT_GT(deposited, 5u);
    EXPECT_GT(halfway, 100u);
}

TEST_F(HydraulicTest, NothingComesFreeBelowTheThreshold)
{
    for (const float part : {0.98f, 1.1f}) {
        sim::SimulationSettings its = prescribed();
        its.hydraulic->params.threshold[0] = static_cast<float>(stress_of(its, 1.0)) / part;
        its.hydraulic->params.rate[0] = 1e9f;
        sim::Simulation simulation(context(), bed_under_flow(1.0f), its);
        simulation.advance(40);
        const std::vector<double> damage = simulation.damage();
        if (part < 1.0f) {
            EXPECT_EQ(*std::ranges::max_element(damage), 0.0);
            EXPECT_EQ(count(simulation.download(), shared::STATE_SOLID), 800u);
        } else {
            EXPECT_LE(count(simulation.download(), shared::STATE_SOLID), 600u); // a layer is gone at least
        }
    }
}

TEST_F(HydraulicTest, TheRateIsAPowerOfTheExcess)
{
    for (const double exponent : {1.0, 1.5}) {
        std::vector<glm::dvec2> points; // logarithms of excess and rate
        for (const double speed : {0.06, 0.08, 0.12, 0.2, 0.4, 0.8, 1.6, 3.2}) {
            sim::SimulationSettings its = prescribed();
            its.hydraulic->params.exponent[0] = static_cast<float>(exponent);
            const ParticleSet start = bed_under_flow(static_cast<float>(speed));
            sim::Simulation simulation(context(), start, its);
            simulation.advance(1);
            simulation.advance(simulation.steps_until_erosion() + 1);
            const std::vector<double> damage = simulation.damage();
            double sum = 0.0;
            for (std::size_t i = 0; i < start.size(); ++i) {
                const glm::vec3 x = start.position[i];
                sum += x.z > 0.2f && x.z < 0.3f && x.x > 0.4f && x.x < 0.6f ? damage[i] : 0.0;
            }
            const double excess = stress_of(its, speed) - static_cast<double>(its.hydraulic->params.threshold[0]);
            points.emplace_back(std::log(excess),
                                std::log(sum / (simulation.time() - static_cast<double>(its.params.dt))));
        }
        glm::dvec2 mean(0.0);
        for (const glm::dvec2& point : points) {
            mean += point / static_cast<double>(points.size());
        }
        double above = 0.0;
        double below = 0.0;
        for (const glm::dvec2& point : points) {
            above += (point.x - mean.x) * (point.y - mean.y);
            below += (point.x - mean.x) * (point.x - mean.x);
        }
        EXPECT_NEAR(above / below, exponent, 0.05);
    }
}

TEST_F(HydraulicTest, FasterFlowCarriesMoreOff)
{
    double before = 0.0;
    for (const float speed : {0.4f, 0.8f, 1.6f, 3.2f}) {
        sim::SimulationSettings its = settings(shared::SOLVER_DFSPH);
        make_channel(its);
        set_viscosity(its.params, 1e-3f);
        its.hydraulic->params.threshold[0] = 2.0f;
        its.hydraulic->params.rate[0] = 100.0f;
        sim::Simulation simulation(context(), bed_under_flow(speed), its);
        simulation.advance(250);
        double lost = 0.0; // particles, in part and whole
        for (const double each : simulation.damage()) {
            lost += each;
        }
        EXPECT_GT(lost, before + 20.0) << speed << " m/s";
        before = lost;
    }
}

TEST_F(HydraulicTest, NoLookTakesMoreThanATwentiethOfAParticle)
{
    sim::SimulationSettings its = settings();
    make_channel(its);
    its.hydraulic->params.rate[0] = 40.0f;
    its.hydraulic->params.time_scale = 30.0f;
    sim::Simulation simulation(context(), bed_under_flow(2.0f), its);
    std::vector<double> before = simulation.damage();
    double largest = 0.0;
    bool some_look_early = false;
    for (int look = 0; look < 60; ++look) {
        simulation.advance(1);
        const std::vector<double> now = simulation.damage();
        for (std::size_t i = 0; i < now.size(); ++i) {
            largest = std::max(largest, now[i] < 1.0 ? now[i] - before[i] : 0.0);
        }
        before = now;
        some_look_early = some_look_early || simulation.steps_until_erosion() < 3;
        simulation.advance(simulation.steps_until_erosion());
    }
    EXPECT_LE(largest, 0.05 * (1.0 + 1e-5));
    EXPECT_GT(largest, 0.03);
    EXPECT_TRUE(some_look_early);
}

TEST_F(HydraulicTest, SedimentThatRestsIsSolidAgain)
{
    sim::SimulationSettings its = settings();
    its.params.dt = 5e-4f;
    its.hydraulic->params.deposition_speed = 0.1f;
    its.hydraulic->params.deposition_time = 0.08f;
    ParticleSet start;
    add_block(start, {4, 4, 4}, glm::vec3(0.3f, 0.0f, 0.3f), shared::STATE_SOLID);
    const auto first = static_cast<std::uint32_t>(start.size());
    const glm::vec3 places[] = {{0.15f, 0.15f, 0.15f}, // falls to the floor
                                {0.8f, 0.15f, 0.15f},  // the same, but of what does not settle
                                {0.15f, 0.15f, 0.8f},  // and water
                                {0.8f, 0.026f, 0.8f}}; // and one that lies already
    for (const glm::vec3& place : places) {
        add_particle(start, place);
        start.attributes.back() =
            shared::freed_as(start.attributes.back(), shared::STATE_FLUID, shared::CAUSE_HYDRAULIC);
    }
    start.attributes[first + 1] |= shared::pack_attributes(0, 1);
    its.hydraulic->params.deposits[1] = 0;
    start.attributes[first + 2] = shared::pack_attributes(shared::STATE_FLUID, 0);
    start.release_time.assign(start.size(), std::numeric_limits<float>::infinity());
    sim::Simulation simulation(context(), start, its);
    std::vector<double> slow_since(start.size(), std::numeric_limits<double>::infinity());
    std::vector<double> solid_since = slow_since;
    while (simulation.time() < 1.0) {
        simulation.advance(1);
        simulation.advance(simulation.steps_until_erosion());
        const ParticleSet now = simulation.download();
        for (std::size_t i = first; i < now.size(); ++i) {
            const bool is_slow = glm::length(now.velocity[i]) < its.hydraulic->params.deposition_speed;
            const bool is_solid = shared::particle_state(now.attributes[i]) == shared::STATE_SOLID;
            slow_since[i] = is_slow || is_solid ? std::min(slow_since[i], simulation.time())
                                                : std::numeric_limits<double>::infinity();
            if (is_solid && solid_since[i] > simulation.time()) {
                solid_since[i] = simulation.time();
                EXPECT_NEAR(now.position[i].y, 0.5f * test_spacing, 0.5f * test_spacing) << i;
            }
        }
    }
    EXPECT_GT(solid_since[first], slow_since[first] + 0.07);
    EXPECT_LT(solid_since[first], slow_since[first] + 0.2);
    EXPECT_TRUE(std::isinf(solid_since[first + 1]));
    EXPECT_TRUE(std::isinf(solid_since[first + 2]));
    EXPECT_LT(solid_since[first + 3], 0.1);
    EXPECT_EQ(simulation.deposited(), 2u);
}

TEST_F(HydraulicTest, SedimentSlidesOffSteepFlanks)
{
    sim::SimulationSettings its = settings();
    its.params.gravity = glm::vec3(-9.81f, 0.0f, 0.0f); // that what stands beside the block hangs on its flank
    its.hydraulic->params.deposition_speed = 1e6f;
    its.hydraulic->params.deposition_time = 1e-6f;
    its.params.dt = 1e-6f;
    ParticleSet start;
    add_block(start, {6, 6, 6}, glm::vec3(0.3f, 0.3f, 0.3f), shared::STATE_SOLID);
    const auto first = static_cast<std::uint32_t>(start.size());
    for (const glm::vec3& way : {glm::vec3(0.18f, 0.0f, 0.0f), glm::vec3(-0.18f, 0.0f, 0.0f),
                                 glm::vec3(0.0f, 0.18f, 0.0f), glm::vec3(0.0f, 0.0f, -0.18f)}) {
        add_particle(start, glm::vec3(0.45f) + way);
        start.attributes.back() =
            shared::freed_as(start.attributes.back(), shared::STATE_FLUID, shared::CAUSE_HYDRAULIC);
    }
    start.release_time.assign(start.size(), std::numeric_limits<float>::infinity());
    sim::Simulation simulation(context(), start, its);
    simulation.advance(20);
    const ParticleSet now = simulation.download();
    EXPECT_EQ(shared::particle_state(now.attributes[first]), shared::STATE_SOLID); // on top, up being x
    for (std::uint32_t i = first + 1; i < now.size(); ++i) {
        EXPECT_EQ(shared::particle_state(now.attributes[i]), shared::STATE_FLUID) << i;
    }
}

TEST_F(HydraulicTest, WhatIsCarriedOffIsNotKicked)
{
    sim::SimulationSettings its = settings();
    its.params.gravity = glm::vec3(0.0f);
    make_channel(its);
    its.hydraulic->params.threshold[0] = 0.1f;
    its.hydraulic->params.rate[0] = 1e4f;
    const float speed = 0.1f;
    sim::Simulation simulation(context(), bed_under_flow(speed), its);
    for (int portion = 0; portion < 10; ++portion) {
        simulation.advance(20);
        for (const glm::vec3& v : simulation.download().velocity) {
            ASSERT_LT(glm::length(v), speed + 0.02f * its.params.speed_of_sound);
        }
    }
    EXPECT_LT(count(simulation.download(), shared::STATE_SOLID), 600u);
}

TEST_F(HydraulicTest, NobodyIsLostWhileAStreamErodesAndSettles)
{
    sim::SimulationSettings its = settings(shared::SOLVER_DFSPH);
    make_channel(its);
    its.hydraulic->params.rate[0] = 60.0f;
    its.hydraulic->params.deposition_speed = 1.2f;
    its.hydraulic->params.deposition_time = 0.02f;
    its.emission.sinks.push_back({.low = {0.9f, 0.3f, 0.0f}, .shape = shared::SINK_BLOCK, .high = {1.0f, 1.0f, 1.0f}});
    ParticleSet runs[2];
    std::vector<double> damage[2];
    for (int run = 0; run < 2; ++run) {
        sim::Simulation simulation(context(), bed_under_flow(2.5f), its);
        for (int portion = 0; portion < 40; ++portion) {
            simulation.advance(10);
            const ParticleSet now = simulation.download();
            ASSERT_EQ(count(now, shared::STATE_FLUID) + count(now, shared::STATE_SOLID),
                      now.size() - simulation.ledger().sunk);
            ASSERT_EQ(count(now, shared::STATE_DEAD), simulation.ledger().sunk);
        }
        EXPECT_GT(simulation.ledger().sunk, 50u);
        EXPECT_GT(simulation.deposited(), 20u);
        runs[run] = simulation.download();
        damage[run] = simulation.damage();
        std::vector<std::uint32_t> ids = runs[run].id;
        std::ranges::sort(ids);
        for (std::uint32_t i = 0; i < ids.size(); ++i) {
            ASSERT_EQ(ids[i], i);
            ASSERT_TRUE(std::isfinite(runs[run].position[i].x + runs[run].velocity[i].x));
        }
    }
    EXPECT_EQ(runs[0].attributes, runs[1].attributes);
    EXPECT_EQ(runs[0].position, runs[1].position);
    EXPECT_EQ(runs[0].velocity, runs[1].velocity);
    EXPECT_EQ(damage[0], damage[1]);
}

} // namespace
} // namespace meltpoint
