// Pieces of solids that nothing holds: against the twins, and against what mechanics says of rigid bodies.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "reference/cells.h"
#include "reference/exposure.h"
#include "reference/fragments.h"
#include "reference/heat.h"
#include "reference/melting.h"
#include "reference/state.h"
#include "reference/visibility.h"
#include "sim/visibility.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

constexpr double d = static_cast<double>(test_spacing);

class FragmentsTest : public GpuTest {
protected:
    static sim::SimulationSettings settings(std::uint32_t solver = shared::SOLVER_WCSPH)
    {
        sim::SimulationSettings settings = test_settings(shared::KERNEL_WENDLAND);
        settings.options.solver = solver;
        settings.options.still = true;
        settings.params.dt = 1e-3f;
        settings.fragments.emplace();
        for (float& friction : settings.fragments->params.sliding_friction) {
            friction = 0.5f;
        }
        settings.fragments->params.anchor[2] = shared::ANCHOR_ALL;
        settings.fragments->params.anchor[3] = shared::ANCHOR_NONE;
        return settings;
    }

    /// count particles along each axis, the first cell's corner at `corner` (m).
    static void add_block(ParticleSet& set, const glm::ivec3& count, const glm::vec3& corner, std::uint32_t state,
                          std::uint32_t material = 0)
    {
        for (int i = 0; i < count.x * count.y * count.z; ++i) {
            const glm::vec3 cell(i % count.x, i / count.x % count.y, i / (count.x * count.y));
            add_particle(set, corner + test_spacing * (cell + 0.5f));
            set.attributes.back() = shared::pack_attributes(state, material);
        }
        set.release_time.assign(set.size(), std::numeric_limits<float>::infinity());
    }

    static std::size_t count_if(const ParticleSet& set, bool (*is_one)(std::uint32_t))
    {
        return static_cast<std::size_t>(std::ranges::count_if(set.attributes, is_one));
    }

    static std::size_t count(const ParticleSet& set, std::uint32_t state)
    {
        return static_cast<std::size_t>(std::ranges::count_if(
            set.attributes, [&](std::uint32_t each) { return shared::particle_state(each) == state; }));
    }

    static reference::Settings twin_settings(const sim::Simulation& simulation, const sim::SimulationSettings& its)
    {
        return {.kernel = its.options.kernel,
                .params = simulation.params(),
                .solver = its.options.solver,
                .dimensions = its.options.dimensions};
    }

    static glm::dvec3 center_of(const ParticleSet& set, bool (*is_one)(std::uint32_t) = shared::is_loose)
    {
        glm::dvec3 sum(0.0);
        double mass = 0.0;
        for (std::size_t i = 0; i < set.size(); ++i) {
            if (is_one(set.attributes[i])) {
                sum += static_cast<double>(set.mass[i]) * glm::dvec3(set.position[i]);
                mass += static_cast<double>(set.mass[i]);
            }
        }
        return sum / mass;
    }

    static double fastest(const ParticleSet& set)
    {
        double speed = 0.0;
        for (std::size_t i = 0; i < set.size(); ++i) {
            speed =
                std::max(speed, shared::is_loose(set.attributes[i]) ? glm::length(glm::dvec3(set.velocity[i])) : 0.0);
        }
        return speed;
    }
};

/// Clumps of solid of three ways to be held, some of them crumbling, over a plate and between walls.
ParticleSet clumps(float jitter, std::uint64_t seed)
{
    Random random(seed);
    ParticleSet set;
    for (int z = 0; z < 19; ++z) {
        for (int y = 0; y < 19; ++y) {
            for (int x = 0; x < 19; ++x) {
                if (random.uniform() > 0.14) { // below the share at which all would be one piece
                    continue;
                }
                const glm::vec3 cell(static_cast<float>(x) + 1.0f, static_cast<float>(y) + 1.0f,
                                     static_cast<float>(z) + 1.0f);
                add_particle(set, test_spacing * (cell + jitter * (random_vector(random) - 0.5f)));
                const auto material = static_cast<std::uint32_t>(random.uniform() < 0.03 ? 2 : (x < 9 ? 0 : 3));
                set.attributes.back() =
                    shared::pack_attributes(shared::STATE_SOLID, material) | (y > 9 ? shared::FLAG_CRUMBLES : 0u);
            }
        }
    }
    add_plate(set, 1.0f, 0.32f, 0.7f * test_spacing, 0.2f, seed);
    set.release_time.assign(set.size(), std::numeric_limits<float>::infinity());
    return set;
}

TEST_F(FragmentsTest, PiecesAreTheTwins)
{
    for (const std::uint32_t periodic : {0u, 0x03u, 0x3fu}) {
        for (const float jitter : {0.0f, 0.6f}) {
            sim::SimulationSettings its = settings();
            its.params.periodic_mask = periodic;
            its.params.wall_mask &= ~periodic;
            const ParticleSet start = clumps(jitter, 4);
            const sim::Simulation simulation(context(), start, its);
            reference::State twin = reference::from_particle_set(start);
            const std::vector<std::uint32_t> nobody(start.size(), shared::NO_BODY);
            const auto piece = reference::find_pieces(twin_settings(simulation, its), twin, nobody);
            const shared::PieceChanges changes =
                reference::loosen_pieces(twin_settings(simulation, its), its.fragments->params, twin, piece);
            EXPECT_EQ(simulation.fragments()->download_labels(), piece);
            EXPECT_EQ(simulation.download().attributes, twin.attributes);
            EXPECT_GT(changes.loosened, 20u);
            EXPECT_GT(changes.crumbled, 20u);
            EXPECT_GT(count_if(simulation.download(), shared::is_still), changes.loosened); // some are held
            EXPECT_EQ(count_if(simulation.download(), [](std::uint32_t each) { return !shared::is_still(each); }),
                      simulation.params().moving_count);
        }
    }
}

TEST_F(FragmentsTest, LongChainsAreOnePiece)
{
    sim::SimulationSettings its = settings();
    its.params.domain_max = glm::vec3(2.0f);
    std::vector<glm::ivec3> places; // lines to and fro, layer after layer, two apart, with a link from each to the next
    int side = 0;
    for (int z = 0; z < 18; z += 2) {
        for (int row = 0; row < 18; row += 2) {
            const int y = z % 4 == 0 ? row : 16 - row;
            for (int x = 0; x < 35; ++x) {
                places.emplace_back(x, y, z);
            }
            side = 34 - side;
            const bool last = row == 16;
            places.emplace_back(side, y + (last ? 0 : (z % 4 == 0 ? 1 : -1)), z + (last ? 1 : 0));
        }
    }
    Random random(2); // ids know nothing of the way
    for (std::size_t i = places.size(); i > 1; --i) {
        std::swap(places[i - 1], places[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
    }
    ParticleSet start;
    for (const glm::ivec3& place : places) {
        add_particle(start, test_spacing * (glm::vec3(place) + 1.5f));
        start.attributes.back() = shared::pack_attributes(shared::STATE_SOLID, 3);
    }
    start.release_time.assign(start.size(), std::numeric_limits<float>::infinity());
    const sim::Simulation simulation(context(), start, its);
    EXPECT_EQ(simulation.fragments()->download_labels(), std::vector<std::uint32_t>(start.size(), 0u));
    EXPECT_EQ(simulation.fragments()->bodies(), 1u);
}

TEST_F(FragmentsTest, StepsAreTheTwins)
{
    sim::SimulationSettings its = settings();
    its.params.dt = 2e-3f;
    ParticleSet start; // a plate, a block that falls on it, two that collide in the air, and one at a wall
    add_plate(start, 1.0f, 0.1f, 0.7f * test_spacing, 0.2f, 3);
    const std::size_t solids = start.size();
    add_block(start, {6, 3, 4}, {0.31f, 0.16f, 0.32f}, shared::STATE_SOLID, 3);
    add_block(start, {3, 3, 3}, {0.2f, 0.5f, 0.2f}, shared::STATE_SOLID, 3);
    add_block(start, {3, 4, 3}, {0.45f, 0.54f, 0.23f}, shared::STATE_SOLID, 3);
    add_block(start, {3, 3, 3}, {0.82f, 0.4f, 0.8f}, shared::STATE_SOLID, 3);
    for (std::size_t i = solids; i < start.size(); ++i) {
        const glm::vec3& x = start.position[i];
        start.velocity[i] = x.y < 0.35f
                                ? glm::vec3(0.3f, -0.4f, 0.2f) + glm::cross(glm::vec3(1.0f, 2.0f, -1.5f), x - 0.3f)
                                : glm::vec3(x.x < 0.4f ? 1.5f : (x.x < 0.7f ? -1.0f : 0.8f), 0.2f, 0.3f);
    }
    sim::Simulation simulation(context(), start, its);
    ASSERT_EQ(simulation.fragments()->bodies(), 4u);
    std::size_t touching = 0;
    std::size_t across_walls = 0;
    std::size_t shared_work = 0;
    const reference::Settings twin_its = twin_settings(simulation, its);
    std::vector<reference::RigidBody> bodies;
    for (int step = 0; step < 120; ++step) {
        reference::State twin = reference::from_particle_set(simulation.download());
        const auto labels = simulation.fragments()->download_labels();
        const std::vector<reference::RigidBody> before = std::exchange(bodies, make_bodies(twin_its, twin, labels));
        for (std::size_t b = 0; b < before.size(); ++b) {
            bodies[b].contacts = before[b].contacts;
        }
        std::vector<glm::dvec3> no_fluid(twin.size(), glm::dvec3(0.0));
        step_bodies(twin_its, its.fragments->params, twin, bodies, no_fluid);
        simulation.advance(1);
        const ParticleSet found = simulation.download();
        for (std::size_t i = 0; i < found.size(); ++i) {
            ASSERT_LT(glm::distance(glm::dvec3(found.position[i]), twin.position[i]), 2e-6) << i << " in " << step;
            ASSERT_LT(glm::distance(glm::dvec3(found.velocity[i]), twin.velocity[i]), 1e-3) << i << " in " << step;
        }
        for (const reference::RigidBody& body : bodies) {
            for (const reference::BodyContact& contact : body.contacts) {
                touching += contact.slot == 0 ? 1 : 0;
                across_walls += contact.slot > 0 ? 1 : 0;
                shared_work += contact.velocity != glm::dvec3(0.0) ? 1 : 0;
            }
        }
    }
    EXPECT_GT(touching, 500u);
    EXPECT_GT(across_walls, 20u);
    EXPECT_GT(shared_work, 20u);
}

TEST_F(FragmentsTest, APieceFallsAsGravityHasItAndComesToRest)
{
    for (const bool on_collider : {false, true}) {
        sim::SimulationSettings its = settings();
        ParticleSet start;
        add_block(start, {6, 5, 4}, {0.3f, 0.5f, 0.4f}, shared::STATE_SOLID);
        if (on_collider) {
            add_plate(start, 1.0f, 0.2f, 0.7f * test_spacing, 0.2f, 3);
            start.release_time.assign(start.size(), std::numeric_limits<float>::infinity());
        }
        sim::Simulation simulation(context(), start, its);
        const glm::dvec3 from = center_of(simulation.download());
        simulation.advance(150);
        const glm::dvec3 fallen = center_of(simulation.download());
        EXPECT_NEAR(fallen.y, from.y - 0.5 * 9.81 * 0.15 * 0.15, 0.002); // symplectic Euler: half a step's way more
        simulation.advance(850);
        const ParticleSet landed = simulation.download();
        const double floor = on_collider ? 0.2 + 0.75 * d : 0.5 * d;
        const glm::dvec3 at_rest = center_of(landed);
        EXPECT_NEAR(at_rest.y, floor + 2.0 * d, 0.1 * d);
        simulation.advance(1000);
        const ParticleSet later = simulation.download();
        EXPECT_LT(fastest(later), 1e-3);
        EXPECT_LT(glm::distance(center_of(later), at_rest), 0.005 * d);
    }
}

TEST_F(FragmentsTest, FrictionHoldsWhatIsNotTooSteep)
{
    for (const double slope : {0.7, 1.4}) { // times atan(mu)
        sim::SimulationSettings its = settings();
        const double angle = slope * std::atan(0.5);
        its.params.gravity = glm::vec3(
            9.81 * glm::dvec3(std::sin(angle), -std::cos(angle), 0.0)); // the floor is level, and all else tilts
        ParticleSet start;
        add_block(start, {6, 3, 5}, {0.1f, 0.0f, 0.4f}, shared::STATE_SOLID, 3);
        sim::Simulation simulation(context(), start, its);
        const glm::dvec3 from = center_of(simulation.download());
        simulation.advance(300);
        const double way = center_of(simulation.download()).x - from.x;
        const double slide = 0.5 * 9.81 * (std::sin(angle) - 0.5 * std::cos(angle)) * 0.3 * 0.3;
        EXPECT_NEAR(way, slope < 1.0 ? 0.0 : slide, slope < 1.0 ? 1e-4 : 0.05 * slide);
    }
}

struct Momenta {
    glm::dvec3 linear{0.0};  ///< kg m/s
    glm::dvec3 angular{0.0}; ///< kg m^2/s, around the origin
};

Momenta momenta_of(const ParticleSet& set)
{
    Momenta sum;
    for (std::size_t i = 0; i < set.size(); ++i) {
        const glm::dvec3 momentum = static_cast<double>(set.mass[i]) * glm::dvec3(set.velocity[i]);
        sum.linear += momentum;
        sum.angular += glm::cross(glm::dvec3(set.position[i]), momentum);
    }
    return sum;
}

TEST_F(FragmentsTest, WhatSplitsKeepsItsMomentumAndAngularMomentum)
{
    sim::SimulationSettings its = settings();
    its.params.gravity = glm::vec3(0.0f);
    its.params.wall_mask = 0;
    set_viscosity(its.params, 0.0f);
    ParticleSet start; // two blocks of different size, and a bridge that goes away
    add_block(start, {5, 4, 5}, {0.15f, 0.4f, 0.35f}, shared::STATE_SOLID);
    add_block(start, {4, 6, 4}, {0.55f, 0.4f, 0.35f}, shared::STATE_SOLID);
    const std::size_t solids = start.size();
    add_block(start, {3, 2, 2}, {0.4f, 0.45f, 0.4f}, shared::STATE_SOLID);
    std::fill(start.release_time.begin() + static_cast<std::ptrdiff_t>(solids), start.release_time.end(), 0.05f);
    for (std::size_t i = 0; i < start.size(); ++i) {
        start.velocity[i] =
            glm::vec3(0.2f, -0.1f, 0.05f) + glm::cross(glm::vec3(1.0f, -2.0f, 1.5f), start.position[i] - 0.5f);
    }
    sim::Simulation simulation(context(), start, its);
    const Momenta before = momenta_of(simulation.download());
    EXPECT_EQ(simulation.fragments()->bodies(), 1u);
    simulation.advance(49);
    const Momenta spun = momenta_of(simulation.download());
    EXPECT_LT(glm::distance(spun.linear, before.linear), 2e-6 * glm::length(before.linear));
    EXPECT_LT(glm::distance(spun.angular, before.angular), 2e-5 * glm::length(before.angular));
    simulation.advance(51);
    const Momenta after = momenta_of(simulation.download());
    EXPECT_EQ(simulation.fragments()->bodies(), 2u);
    EXPECT_EQ(count(simulation.download(), shared::STATE_FLUID), 12u);
    EXPECT_LT(glm::distance(after.linear, before.linear), 1e-3 * glm::length(before.linear)); // of fluid: half a kick
    EXPECT_LT(glm::distance(after.angular, before.angular), 1e-3 * glm::length(before.angular));
}

TEST_F(FragmentsTest, ASpinningBodyKeepsItsEnergy)
{
    sim::SimulationSettings its = settings();
    its.params.gravity = glm::vec3(0.0f);
    ParticleSet start; // around its middle axis, which does not last
    add_block(start, {9, 6, 2}, {0.27f, 0.35f, 0.45f}, shared::STATE_SOLID);
    for (std::size_t i = 0; i < start.size(); ++i) {
        start.velocity[i] = glm::cross(glm::vec3(0.05f, 6.0f, 0.0f), start.position[i] - glm::vec3(0.495f, 0.5f, 0.5f));
    }
    sim::Simulation simulation(context(), start, its);
    const auto energy = [&] {
        double sum = 0.0;
        const ParticleSet now = simulation.download();
        for (std::size_t i = 0; i < now.size(); ++i) {
            const glm::dvec3 v(now.velocity[i]);
            sum += 0.5 * static_cast<double>(now.mass[i]) * glm::dot(v, v);
        }
        return sum;
    };
    const double before = energy();
    bool has_turned_over = false;
    for (int portion = 0; portion < 30; ++portion) {
        simulation.advance(100);
        const shared::Body body = simulation.fragments()->download_bodies().at(0);
        const glm::vec4 q = body.orientation;
        const float up = 1.0f - 2.0f * (q.x * q.x + q.z * q.z); // y of what was up
        has_turned_over = has_turned_over || up < -0.8f;
        EXPECT_NEAR(energy() / before, 1.0, 1e-3);
    }
    EXPECT_TRUE(has_turned_over); // Dzhanibekov
}

TEST_F(FragmentsTest, TheFarEndOfACutBarFallsAndTheNearEndStays)
{
    sim::SimulationSettings its = settings();
    ParticleSet start;
    add_block(start, {16, 3, 4}, {0.0f, 0.6f, 0.4f}, shared::STATE_SOLID);
    for (std::size_t i = 0; i < start.size(); ++i) {
        const float x = start.position[i].x / test_spacing;
        start.release_time[i] = x > 6.0f && x < 8.0f ? 0.02f : std::numeric_limits<float>::infinity();
    }
    sim::Simulation simulation(context(), start, its);
    EXPECT_EQ(simulation.fragments()->bodies(), 0u); // all of it hangs on the wall
    simulation.advance(20);
    EXPECT_EQ(count_if(simulation.download(), shared::is_still), start.size());
    double loose_at =
        0.0; // at a look, when it could have fallen by half of a spacing since the last search, at the start
    for (int step = 0; step < 60 && simulation.fragments()->bodies() == 0; ++step) {
        loose_at = simulation.time();
        simulation.advance(1);
    }
    const double half = std::sqrt(static_cast<double>(test_spacing) / 9.81);
    EXPECT_GE(loose_at, half);
    EXPECT_LE(loose_at, half + 32.0 * static_cast<double>(its.params.dt));
    simulation.advance(160);
    const ParticleSet after = simulation.download();
    EXPECT_EQ(simulation.fragments()->bodies(), 1u);
    EXPECT_EQ(count(after, shared::STATE_FLUID), 24u);
    double way = 0.0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (start.position[i].x < 6.0f * test_spacing) {
            EXPECT_EQ(after.position[i], start.position[i]);
        } else if (start.position[i].x > 8.0f * test_spacing) {
            EXPECT_TRUE(shared::is_loose(after.attributes[i]));
            way += static_cast<double>(start.position[i].y - after.position[i].y) / 96.0;
        }
    }
    const double seconds = simulation.time() - loose_at;
    EXPECT_NEAR(way, 0.5 * 9.81 * seconds * seconds, 0.02 * way);
}

TEST_F(FragmentsTest, TouchingBodiesStayApart)
{
    sim::SimulationSettings its = settings();
    its.params.gravity = glm::vec3(0.0f);
    ParticleSet start; // two blocks that fly into each other; later one of them loses a particle
    add_block(start, {3, 4, 4}, {0.2f, 0.4f, 0.4f}, shared::STATE_SOLID);
    add_block(start, {3, 4, 4}, {0.5f, 0.4f, 0.4f}, shared::STATE_SOLID);
    for (std::size_t i = 0; i < start.size(); ++i) {
        start.velocity[i].x = start.position[i].x < 0.45f ? 1.0f : -1.0f;
    }
    start.release_time[0] = 0.15f;
    sim::Simulation simulation(context(), start, its);
    simulation.advance(100);
    const ParticleSet before = simulation.download();
    EXPECT_NEAR(static_cast<double>(before.position[48].x - before.position[2].x), d, 0.1 * d);
    EXPECT_LT(fastest(before), 0.02); // head on, and nothing springs back
    simulation.advance(100);
    EXPECT_EQ(count(simulation.download(), shared::STATE_FLUID), 1u);
    EXPECT_EQ(simulation.fragments()->bodies(), 2u);
}

TEST_F(FragmentsTest, WhatHasLandedIsLooseStill)
{
    sim::SimulationSettings its = settings();
    ParticleSet start; // it stands on its side, and topples
    add_block(start, {2, 8, 4}, {0.4f, 0.1f, 0.4f}, shared::STATE_SOLID);
    start.release_time[63] = 0.1f; // a corner is lost when it has landed
    sim::Simulation simulation(context(), start, its);
    EXPECT_EQ(simulation.fragments()->bodies(), 1u);
    simulation.advance(300);
    const ParticleSet after = simulation.download();
    EXPECT_EQ(count(after, shared::STATE_FLUID), 1u);
    EXPECT_EQ(count_if(after, shared::is_loose), 63u);
    EXPECT_EQ(simulation.fragments()->bodies(), 1u);
}

TEST_F(FragmentsTest, BodiesAreSeenByTheTimeStep)
{
    sim::SimulationSettings its = settings();
    its.params.gravity = glm::vec3(0.0f);
    its.params.adaptive_dt = 1;
    its.params.cfl_length = 0.02f;
    its.params.cfl_speed = 1.0f;
    its.params.longest_dt = its.params.dt = 0.1f;
    its.params.longest_move = 0.1f;
    ParticleSet start;
    add_block(start, {3, 3, 3}, {0.3f, 0.4f, 0.4f}, shared::STATE_SOLID);
    std::ranges::fill(start.velocity, glm::vec3(3.0f, 0.0f, 0.0f));
    sim::Simulation simulation(context(), start, its);
    simulation.advance(4);
    EXPECT_NEAR(simulation.time(), 4 * 0.02 / (1.0 + 3.0), 1e-6);
}

TEST_F(FragmentsTest, ABodyThatLeavesTheDomainEndsTheRun)
{
    sim::SimulationSettings its = settings();
    its.params.wall_mask = 0;
    ParticleSet start;
    add_block(start, {3, 3, 3}, {0.3f, 0.1f, 0.4f}, shared::STATE_SOLID);
    sim::Simulation simulation(context(), start, its);
    EXPECT_THROW(simulation.advance(400), Error);
}

/// Ice on the floor and a block of it that nothing holds, half in water that is too cold or warm.
sim::SimulationSettings with_heat(sim::SimulationSettings its, const ParticleSet& start)
{
    its.melting.emplace();
    for (const std::uint32_t material : {0u, 3u}) {
        its.melting->heat.of[material] = {.solid_conductivity = 2.2f,
                                          .fluid_conductivity = 0.6f,
                                          .solid_specific_heat = 2100.0f,
                                          .fluid_specific_heat = 4186.0f,
                                          .latent_heat = 334e3f,
                                          .melting_point = 0.0f};
        its.melting->params.absorptivity[material] = 0.7f;
        its.melting->params.melts[material] = 1;
    }
    its.melting->params.sun = 4e7f;
    its.melting->params.sun_direction = glm::normalize(glm::vec3(0.5f, -1.0f, 0.2f));
    its.melting->params.air_temperature = 80.0f;
    its.melting->params.air_transfer = 3e4f;
    its.melting->time_scale = 40.0;
    Random random(12);
    for (const std::uint32_t each : start.attributes) {
        const bool solid = shared::particle_state(each) == shared::STATE_SOLID;
        its.melting->enthalpy.push_back(334e3 * (solid ? 1.1 * random.uniform() - 0.1 : 1.3 * random.uniform() - 0.3));
    }
    return its;
}

TEST_F(FragmentsTest, LooksAtLooseSolidsAreTheTwins)
{
    ParticleSet start;
    add_block(start, {5, 3, 6}, {0.1f, 0.0f, 0.3f}, shared::STATE_SOLID);
    add_block(start, {6, 5, 5}, {0.45f, 0.3f, 0.3f}, shared::STATE_SOLID);
    add_block(start, {8, 2, 6}, {0.4f, 0.2f, 0.3f}, shared::STATE_FLUID);
    add_block(start, {3, 2, 6}, {0.1f, 0.15f, 0.3f}, shared::STATE_FLUID);
    sim::SimulationSettings its = with_heat(settings(), start);
    its.params.dt = 2e-4f;
    sim::Simulation simulation(context(), start, its);
    ASSERT_EQ(simulation.fragments()->bodies(), 1u);
    const reference::Settings twin_its = twin_settings(simulation, its);
    const shared::VisibilityParams map_params =
        sim::visibility_params({.direction = its.melting->params.sun_direction}, simulation.params());
    double largest_change = 0.0;
    std::vector<double> enthalpy_at_last_look = its.melting->enthalpy;
    double looked_at = 0.0;
    std::size_t melted = 0;
    std::size_t frozen = 0;
    std::size_t joined = 0;
    for (int look = 0; look < 9; ++look) {
        const ParticleSet before = simulation.download();
        std::vector<double> enthalpy = simulation.enthalpy();
        const std::vector<double> enthalpy_before = enthalpy;
        const double seconds = (simulation.time() - looked_at) * its.melting->time_scale;
        looked_at = simulation.time();
        reference::State twin = reference::from_particle_set(before);
        const auto exposure = reference::exposure(twin_its, twin);
        const auto seen =
            reference::visibility_of_solids(map_params, reference::depth_map(map_params, twin), twin, exposure);
        reference::warm(twin_its, its.melting->heat, its.melting->params, twin, exposure, seen, enthalpy, seconds);
        reference::conduct(twin_its, its.melting->heat, twin,
                           reference::find_neighbors(simulation.params(), twin.position), enthalpy, seconds);
        const std::size_t loose_before =
            static_cast<std::size_t>(std::ranges::count_if(twin.attributes, shared::is_loose));
        frozen += reference::freeze(twin_its, twin, enthalpy);
        joined += static_cast<std::size_t>(std::ranges::count_if(twin.attributes, shared::is_loose)) - loose_before;
        ASSERT_EQ(simulation.steps_until_erosion(), 0u);
        simulation.advance(1);
        melted += reference::melt(
            its.melting->heat, its.melting->params, twin, enthalpy, enthalpy_at_last_look,
            seconds > 0.0 ? 0.5 * seconds_between_looks(simulation) * its.melting->time_scale / seconds : 0.0);
        // Who has just frozen is of any body: there is but one.
        const auto piece =
            reference::find_pieces(twin_its, twin, std::vector<std::uint32_t>(twin.size(), shared::NO_BODY));
        reference::loosen_pieces(twin_its, its.fragments->params, twin, piece);

        const ParticleSet after = simulation.download();
        const std::vector<double> found = simulation.enthalpy();
        for (std::size_t i = 0; i < after.size(); ++i) {
            ASSERT_EQ(after.attributes[i], twin.attributes[i]) << "particle " << i << " at look " << look;
            largest_change = std::max(largest_change, std::abs(enthalpy[i] - enthalpy_before[i]));
            ASSERT_NEAR(found[i], enthalpy[i], 1e-4 * largest_change) << "particle " << i << " at look " << look;
        }
        EXPECT_EQ(simulation.params().moving_count,
                  count_if(after, [](std::uint32_t each) { return !shared::is_still(each); }));
        simulation.advance(simulation.steps_until_erosion());
    }
    EXPECT_GT(melted, 5u);
    EXPECT_GT(frozen, joined);
    EXPECT_GT(joined, 3u);
}

TEST_F(FragmentsTest, RerunsAreBitIdenticalInAnyPortions)
{
    ParticleSet start; // ice that falls into water, and melts
    add_block(start, {7, 5, 7}, {0.3f, 0.4f, 0.3f}, shared::STATE_SOLID);
    add_block(start, {20, 5, 20}, {0.0f, 0.0f, 0.0f}, shared::STATE_FLUID);
    sim::SimulationSettings its = with_heat(settings(shared::SOLVER_DFSPH), start);
    its.params.dt = 2e-3f;
    ParticleSet seen[2];
    std::vector<shared::Body> bodies;
    for (int run = 0; run < 2; ++run) {
        sim::Simulation simulation(context(), start, its);
        for (std::uint32_t portion = 1; simulation.step() < 200; ++portion) {
            simulation.advance(
                run == 0 ? 200 : std::min(portion % 7 + 1, static_cast<std::uint32_t>(200 - simulation.step())));
        }
        seen[run] = simulation.download();
        bodies = simulation.fragments()->download_bodies();
    }
    EXPECT_EQ(seen[0].attributes, seen[1].attributes);
    EXPECT_EQ(seen[0].position, seen[1].position);
    EXPECT_EQ(seen[0].velocity, seen[1].velocity);
    EXPECT_EQ(seen[0].id, seen[1].id);
    EXPECT_EQ(seen[0].mass, start.mass);
    ASSERT_FALSE(bodies.empty());
    EXPECT_GT(count_if(seen[0], [](std::uint32_t each) { return shared::cause_of(each) == shared::CAUSE_MELT; }), 5u);
}

} // namespace
} // namespace meltpoint
