// Emitters and sinks: what they bring and take, when and where, and that the books of it are exact.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <set>
#include <vector>

#include "reference/emission.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

constexpr double particle_mass = 1000.0 * 0.05 * 0.05 * 0.05;

class EmissionTest : public GpuTest {
protected:
    static sim::SimulationSettings settings(std::uint32_t solver = shared::SOLVER_DFSPH)
    {
        sim::SimulationSettings settings = test_settings(shared::KERNEL_WENDLAND);
        settings.options.solver = solver;
        settings.options.still = true;
        settings.params.dt = solver == shared::SOLVER_WCSPH ? 2e-4f : 2e-3f;
        return settings;
    }

    /// Adds an emitter of layers on a lattice of n x n points, with as many slots, to settings and particles.
    static void add_jet(sim::SimulationSettings& settings, ParticleSet& set, const glm::vec3& corner,
                        const glm::vec3& velocity, int n, std::uint32_t slots)
    {
        shared::Emitter emitter{.velocity = velocity,
                                .start = 0.0037f,
                                .period = test_spacing / glm::length(velocity),
                                .first_point = static_cast<std::uint32_t>(settings.emission.points.size()),
                                .points = static_cast<std::uint32_t>(n * n),
                                .first_id = static_cast<std::uint32_t>(set.size()),
                                .slots = slots,
                                .births = 1'000'000,
                                .seed = 8};
        for (int i = 0; i < n * n; ++i) { // along x
            settings.emission.points.push_back(corner + test_spacing * glm::vec3(0.0f, i / n, i % n));
        }
        add_slots(set, emitter);
        settings.emission.emitters.push_back(emitter);
    }

    static void add_rain(sim::SimulationSettings& settings, ParticleSet& set, float period, std::uint32_t slots)
    {
        const shared::Emitter emitter{.velocity = {0.0f, -3.0f, 0.2f},
                                      .spread = {0.9f, 0.02f, 0.9f},
                                      .period = period,
                                      .jitter = 1.0f,
                                      .first_point = static_cast<std::uint32_t>(settings.emission.points.size()),
                                      .points = 1,
                                      .first_id = static_cast<std::uint32_t>(set.size()),
                                      .slots = slots,
                                      .births = 1'000'000,
                                      .seed = 77};
        settings.emission.points.emplace_back(0.05f, 0.9f, 0.05f);
        add_slots(set, emitter);
        settings.emission.emitters.push_back(emitter);
    }

    static void add_slots(ParticleSet& set, const shared::Emitter& emitter)
    {
        for (std::uint32_t i = 0; i < emitter.slots; ++i) {
            add_particle(set, glm::vec3(0.5f));
            set.attributes.back() = shared::pack_attributes(shared::STATE_DEAD, 0);
            set.weight.back() = 0.0f;
        }
        set.release_time.resize(set.size(), std::numeric_limits<float>::infinity());
    }

    static shared::Sink block(const glm::vec3& low, const glm::vec3& high)
    {
        return {.low = low, .shape = shared::SINK_BLOCK, .high = high};
    }

    static std::size_t count(const ParticleSet& set, std::uint32_t state)
    {
        return static_cast<std::size_t>(std::ranges::count_if(
            set.attributes, [&](std::uint32_t each) { return shared::particle_state(each) == state; }));
    }
};

/// Each drop alone in free flight, so that what becomes of it is known: all of it but the flight is the twin's.
TEST_F(EmissionTest, BirthsAndSinksAreTheTwins)
{
    sim::SimulationSettings its = settings();
    its.params.gravity = glm::vec3(0.0f);
    set_viscosity(its.params, 0.0f);
    ParticleSet start = lattice_state({1, 1, 1}, glm::vec3(0.9f, 0.5f, 0.9f));
    add_rain(its, start, 0.011f, 60);
    add_jet(its, start, {0.2f, 0.4f, 0.4f}, {1.5f, 0.0f, 0.0f}, 1, 9);
    its.emission.sinks = {
        block({0.0f, 0.1f, 0.0f}, {1.0f, 0.3f, 1.0f}),
        {.low = {0.5f, 0.45f, 0.45f}, .shape = shared::SINK_SPHERE, .high = {0.07f, 0.0f, 0.0f}}, // just missed
        {.low = {0.7f, 0.4f, 0.4f}, .shape = shared::SINK_SPHERE, .high = {0.07f, 0.0f, 0.0f}}};
    sim::Simulation simulation(context(), start, its);
    reference::Settings twin_settings{.kernel = its.options.kernel, .params = simulation.params()};
    reference::State twin = reference::from_particle_set(start);
    std::vector<float> birth(start.size(), std::numeric_limits<float>::infinity());
    std::vector<std::uint32_t> next(its.emission.emitters.size(), 0);
    const double dt = static_cast<double>(its.params.dt);
    std::vector<bool> gone(start.size());
    std::transform(start.attributes.begin(), start.attributes.end(), gone.begin(), shared::is_gone);
    shared::Ledger books{};
    std::size_t compared = 0;
    for (std::uint32_t step = 0; step < 200; ++step) {
        if (simulation.steps_until_erosion() == 0) { // the simulation looks before the step to come
            const std::uint32_t interval =
                sim::Erosion::interval(simulation.params().pool_count, simulation.params().moving_count);
            const double horizon = step * dt + interval * dt * (1.0 + static_cast<double>(shared::LANDING_TOLERANCE));
            for (std::size_t e = 0; e < next.size(); ++e) {
                const shared::Emitter& emitter = its.emission.emitters[e];
                const std::uint32_t past =
                    std::max(sim::births_until(emitter, step * dt), emitter.points) - emitter.points;
                next[e] = std::max(next[e], past);
                const std::uint32_t until = std::max(sim::births_until(emitter, horizon), next[e]);
                next[e] += static_cast<std::uint32_t>(
                    reference::call_up(twin, emitter, its.emission.points, next[e], until - next[e], gone, birth));
            }
            for (std::size_t i = 0; i < twin.size(); ++i) {
                gone[i] = shared::is_gone(twin.attributes[i]);
            }
        }
        simulation.advance(1);
        for (std::size_t i = 0; i < twin.size(); ++i) {
            const bool flies = shared::particle_state(twin.attributes[i]) == shared::STATE_FLUID;
            twin.position[i] += flies ? dt * twin.velocity[i] : glm::dvec3(0.0);
        }
        books.emitted += static_cast<std::uint32_t>(
            reference::bear(twin_settings, twin, birth, static_cast<double>(static_cast<float>((step + 1) * dt))));
        books.sunk += static_cast<std::uint32_t>(reference::sink(twin, its.emission.sinks));
        const ParticleSet found = simulation.download();
        for (std::size_t i = 0; i < found.size(); ++i) {
            ASSERT_EQ(found.attributes[i], twin.attributes[i]) << "particle " << i << " after step " << step;
            ASSERT_EQ(found.weight[i], twin.weight[i]);
            ASSERT_EQ(found.mass[i], start.mass[i]);
            if (shared::particle_state(found.attributes[i]) == shared::STATE_FLUID) {
                ASSERT_LT(glm::distance(glm::dvec3(found.position[i]), twin.position[i]), 2e-5) << "particle " << i;
                ++compared;
            }
        }
        ASSERT_EQ(simulation.ledger().emitted, books.emitted);
        ASSERT_EQ(simulation.ledger().sunk, books.sunk);
    }
    EXPECT_GT(books.emitted, 40u);
    EXPECT_GT(books.sunk, 20u);
    EXPECT_GT(compared, 2000u);
}

TEST_F(EmissionTest, EveryStepsBooksBalanceWithEverySolver)
{
    for (const std::uint32_t solver : {shared::SOLVER_WCSPH, shared::SOLVER_DFSPH, shared::SOLVER_PBF}) {
        SCOPED_TRACE(solver);
        sim::SimulationSettings its = settings(solver);
        ParticleSet start = lattice_state({12, 3, 12}, glm::vec3(0.2f, 0.025f, 0.2f));
        const std::size_t initial = start.size();
        add_jet(its, start, {0.1f, 0.5f, 0.4f}, {2.0f, 0.0f, 0.0f}, 4, 90);
        add_rain(its, start, 0.002f, 40);
        its.emission.sinks = {block({0.5f, 0.0f, 0.0f}, {1.0f, 0.2f, 1.0f})};
        sim::Simulation simulation(context(), start, its);
        for (int look = 0; look < 60; ++look) {
            simulation.advance(solver == shared::SOLVER_WCSPH ? 23 : 3);
            const ParticleSet now = simulation.download();
            const shared::Ledger books = simulation.ledger();
            ASSERT_EQ(count(now, shared::STATE_FLUID), initial + books.emitted - books.sunk);
            ASSERT_EQ(count(now, shared::STATE_FLUID) + count(now, shared::STATE_DEAD), start.size());
            const std::set<std::uint32_t> ids(now.id.begin(), now.id.end());
            ASSERT_EQ(ids.size(), start.size());
            ASSERT_EQ(now.mass, start.mass);
        }
        EXPECT_GT(simulation.ledger().emitted, 130u); // more than there are slots: the sink gives them back
        EXPECT_GT(simulation.ledger().sunk, 100u);
    }
}

TEST_F(EmissionTest, BringsWhatFlowsThroughANozzleInTheTime)
{
    sim::SimulationSettings its = settings();
    its.params.gravity = glm::vec3(0.0f);
    its.params.adaptive_dt = 1;
    its.params.cfl_length = 0.4f * test_spacing;
    its.params.longest_dt = 5e-3f;
    its.params.longest_move = 0.5f * its.params.support_radius;
    ParticleSet start;
    add_jet(its, start, {0.05f, 0.4f, 0.4f}, {2.0f, 0.0f, 0.0f}, 4, 400);
    sim::Simulation simulation(context(), start, its);
    constexpr double seconds = 0.4;
    simulation.advance_by(0.1);
    simulation.advance_by(seconds - 0.1);
    const ParticleSet found = simulation.download();
    const double area = std::pow(4.0 * 0.05, 2);
    const double flow = 1000.0 * area * 2.0; // kg/s
    const double layer = 16.0 * particle_mass;
    const double mass = particle_mass * static_cast<double>(count(found, shared::STATE_FLUID));
    EXPECT_NEAR(mass, flow * (seconds - 0.0037), layer);
    for (std::size_t i = 0; i < found.size(); ++i) { // nothing pushed them: the layers join without a seam
        if (shared::particle_state(found.attributes[i]) == shared::STATE_FLUID) {
            EXPECT_LT(glm::distance(found.velocity[i], glm::vec3(2.0f, 0.0f, 0.0f)), 0.02f * 2.0f);
        }
    }
}

TEST_F(EmissionTest, ComesNowhereNearOthers)
{
    sim::SimulationSettings its = settings();
    // In a full corner of the box: nothing comes while fluid stands in the way, and all that has come has its room.
    ParticleSet start = lattice_state({10, 10, 10}, glm::vec3(0.025f));
    const std::size_t initial = start.size();
    add_jet(its, start, {0.21f, 0.19f, 0.2f}, {1.0f, 0.0f, 0.0f}, 4, 400);
    sim::Simulation simulation(context(), start, its);
    std::vector<std::uint32_t> before = simulation.download().attributes;
    simulation.advance(5); // one by one
    EXPECT_EQ(simulation.ledger().emitted, 0u);
    EXPECT_EQ(simulation.missed_births()[0], 0u); // there were slots
    std::size_t born = 0;
    for (int step = 0; step < 300; ++step) {
        simulation.advance(1);
        const ParticleSet now = simulation.download();
        for (std::size_t i = initial; i < now.size(); ++i) {
            const bool is_new = shared::particle_state(now.attributes[i]) == shared::STATE_FLUID &&
                                shared::particle_state(before[i]) == shared::STATE_DEAD;
            for (std::size_t j = 0; is_new && j < now.size(); ++j) {
                if (j != i && shared::particle_state(now.attributes[j]) == shared::STATE_FLUID) {
                    ASSERT_GT(glm::distance(now.position[i], now.position[j]),
                              0.9999f * shared::BIRTH_DISTANCE * test_spacing);
                }
            }
            born += is_new ? 1 : 0;
        }
        before = now.attributes;
    }
    EXPECT_GT(born, 50u); // once the block has slumped
}

TEST_F(EmissionTest, PausesWhenItsParticlesAreOut)
{
    sim::SimulationSettings its = settings();
    ParticleSet start;
    add_jet(its, start, {0.1f, 0.5f, 0.4f}, {2.0f, 0.0f, 0.0f}, 4, 40);
    sim::Simulation simulation(context(), start, its);
    simulation.advance(100);
    EXPECT_EQ(simulation.ledger().emitted, 40u);
    EXPECT_GT(simulation.missed_births()[0], 50u);
    EXPECT_LT(simulation.missed_births()[0], 100u); // of 128 births in all, each counted once
    const ParticleSet found = simulation.download();
    EXPECT_EQ(count(found, shared::STATE_FLUID), 40u);
}

TEST_F(EmissionTest, RerunsAreBitIdentical)
{
    sim::SimulationSettings its = settings();
    its.params.adaptive_dt = 1;
    its.params.cfl_length = 0.4f * test_spacing;
    its.params.longest_dt = 5e-3f;
    its.params.longest_move = 0.5f * its.params.support_radius;
    ParticleSet start = lattice_state({10, 4, 10}, glm::vec3(0.25f, 0.025f, 0.25f));
    add_jet(its, start, {0.1f, 0.4f, 0.4f}, {2.0f, 0.0f, 0.0f}, 4, 150);
    add_rain(its, start, 0.001f, 150); // drops that come at the same time in the same place
    its.emission.sinks = {block({0.5f, 0.0f, 0.0f}, {1.0f, 0.2f, 1.0f})};
    ParticleSet seen[2];
    std::uint32_t emitted = 0;
    for (ParticleSet& each : seen) {
        sim::Simulation simulation(context(), start, its);
        for (int frame = 0; frame < 10; ++frame) {
            simulation.advance_by(0.031);
        }
        each = simulation.download();
        emitted = simulation.ledger().emitted;
    }
    EXPECT_EQ(seen[0].attributes, seen[1].attributes);
    EXPECT_EQ(seen[0].position, seen[1].position);
    EXPECT_EQ(seen[0].velocity, seen[1].velocity);
    EXPECT_GT(emitted, 100u);
}

TEST_F(EmissionTest, OfTwoWhoComeAtOnceToOnePlaceTheFirstIsBorn)
{
    sim::SimulationSettings its = settings();
    its.params.gravity = glm::vec3(0.0f);
    ParticleSet start;
    add_jet(its, start, {0.1f, 0.4f, 0.4f}, {2.0f, 0.0f, 0.0f}, 2, 100);
    for (std::size_t i = 1; i < its.emission.points.size(); ++i) { // all four within a third of a spacing
        its.emission.points[i] =
            its.emission.points[0] + glm::vec3(0.0f, 0.0f, 0.1f * test_spacing * static_cast<float>(i));
    }
    sim::Simulation simulation(context(), start, its);
    simulation.advance(50); // 0.1 s: four layers
    EXPECT_EQ(simulation.ledger().emitted, 4u);
    const ParticleSet found = simulation.download();
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (shared::particle_state(found.attributes[i]) == shared::STATE_FLUID) {
            EXPECT_EQ(found.position[i].z, 0.4f); // that of the first point
        }
    }
}

TEST_F(EmissionTest, StepsAreShortEnoughForWhoHasJustBeenBorn)
{
    sim::SimulationSettings its = settings();
    its.params.adaptive_dt = 1;
    its.params.cfl_length = 0.4f * test_spacing;
    its.params.longest_dt = 5e-3f;
    its.params.longest_move = 0.5f * its.params.support_radius;
    ParticleSet start = lattice_state({1, 1, 1}, glm::vec3(0.5f));        // falls, slowly yet
    add_jet(its, start, {0.1f, 0.4f, 0.4f}, {20.0f, 0.0f, 0.0f}, 1, 100); // 0.1 m in the longest step
    its.emission.emitters[0].start = 0.05f;                               // when steps have grown to their longest
    sim::Simulation simulation(context(), start, its);
    EXPECT_NO_THROW(simulation.advance_by(0.08));
    EXPECT_GT(simulation.ledger().emitted, 8u);
}

TEST_F(EmissionTest, AcrossPeriodicBordersTooNothingComesNearOthers)
{
    sim::SimulationSettings its = settings();
    its.params.gravity = glm::vec3(0.0f);
    its.params.wall_mask &= ~3u;
    its.params.periodic_mask = 3u;
    for (const float x : {0.98f, 0.9f}) { // a fifth and 2.4 spacings away from where the births are
        ParticleSet start = lattice_state({1, 1, 1}, glm::vec3(x, 0.5f, 0.5f));
        sim::SimulationSettings each = its;
        add_jet(each, start, {0.01f, 0.5f, 0.5f}, {0.01f, 0.0f, 0.0f}, 1, 4);
        sim::Simulation simulation(context(), start, each);
        simulation.advance(20);
        EXPECT_EQ(simulation.ledger().emitted, x > 0.95f ? 0u : 1u);
    }
}

} // namespace
} // namespace meltpoint
