// Solids that crumble into dust: how it drifts, that no fluid feels it, and where it ends.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/random.h"
#include "reference/dust.h"
#include "reference/erosion.h"
#include "run/dust_params.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class DustTest : public GpuTest {
protected:
    static sim::SimulationSettings settings(std::uint32_t solver = shared::SOLVER_WCSPH)
    {
        sim::SimulationSettings settings = test_settings(shared::KERNEL_WENDLAND);
        settings.options.solver = solver;
        settings.options.still = true;
        settings.params.dt = 1e-3f;
        Scene scene;
        scene.dust.wind = {0.6f, 0.2f, -0.1f};
        scene.dust.eddy_size = 0.3f;
        scene.dust.life = 0.2f;
        settings.dust = dust_params(scene);
        return settings;
    }

    /// A solid block that crumbles, each particle at a time of its own within `span` seconds.
    static ParticleSet crumbling(double span)
    {
        ParticleSet set = lattice_state({8, 8, 8}, glm::vec3(0.3f));
        std::ranges::fill(set.attributes, shared::pack_attributes(shared::STATE_SOLID, 2) | shared::FLAG_CRUMBLES);
        Random random(8);
        for (std::size_t i = 0; i < set.size(); ++i) {
            set.release_time.push_back(static_cast<float>(span * random.uniform()));
        }
        return set;
    }

    static std::size_t count(const ParticleSet& set, std::uint32_t state)
    {
        return static_cast<std::size_t>(std::ranges::count_if(
            set.attributes, [&](std::uint32_t each) { return shared::particle_state(each) == state; }));
    }
};

TEST_F(DustTest, DriftsAsItsTwin)
{
    for (const bool periodic : {false, true}) {
        SCOPED_TRACE(periodic);
        sim::SimulationSettings its = settings();
        its.params.dt = 2e-3f;
        if (periodic) {
            its.params.wall_mask &= ~3u;
            its.params.periodic_mask = 3u;
            its.dust->wind.x = 8.0f; // once around the domain
            its.dust->response_time = 0.02f;
        }
        ParticleSet start = crumbling(0.0);
        sim::Simulation simulation(context(), start, its);
        reference::Settings twin_settings{.kernel = its.options.kernel, .params = simulation.params()};
        reference::State twin = reference::from_particle_set(start);
        (void)reference::release(twin, start.release_time, 0.0);
        constexpr std::uint32_t steps = 80;
        simulation.advance(steps);
        for (std::uint32_t i = 1; i <= steps; ++i) {
            reference::drift_dust(twin_settings, *its.dust, twin, start.release_time,
                                  i * static_cast<double>(its.params.dt));
        }
        const ParticleSet found = simulation.download();
        double moved = 0.0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(found.attributes[i], twin.attributes[i]);
            EXPECT_LT(glm::distance(glm::dvec3(found.position[i]), twin.position[i]), 1e-4) << "particle " << i;
            EXPECT_LT(glm::distance(glm::dvec3(found.velocity[i]), twin.velocity[i]), 1e-3);
            EXPECT_NEAR(static_cast<double>(found.density[i]), twin.density[i], 1e-4);
            EXPECT_EQ(found.mass[i], start.mass[i]);
            EXPECT_EQ(found.weight[i], 0.0f);
            moved += glm::distance(glm::dvec3(start.position[i]), twin.position[i]);
        }
        EXPECT_GT(moved, 0.01 * static_cast<double>(found.size()));
        EXPECT_GT(count(found, shared::STATE_DUST), periodic ? 500u : 400u);
    }
}

TEST_F(DustTest, StepsThatTheDeviceChoosesKeepItsTime)
{
    sim::SimulationSettings its = settings(shared::SOLVER_DFSPH);
    its.params.adaptive_dt = 1;
    its.params.cfl_length = 0.4f * test_spacing;
    its.params.longest_dt = 2e-3f;
    its.params.longest_move = 0.5f * its.params.support_radius;
    const ParticleSet start = crumbling(0.0);
    sim::Simulation simulation(context(), start, its);
    for (int frame = 0; frame < 5; ++frame) {
        simulation.advance_by(0.0151);
    }
    const ParticleSet found = simulation.download();
    for (std::size_t i = 0; i < found.size(); ++i) { // what is left of it says how long it has been drifting
        EXPECT_NEAR(found.density[i], 1.0 - simulation.time() / 0.2, 1e-3);
    }
}

TEST_F(DustTest, NoFluidFeelsIt)
{
    int round = 0;
    for (const std::uint32_t solver :
         {shared::SOLVER_WCSPH, shared::SOLVER_DFSPH, shared::SOLVER_PBF, shared::SOLVER_DFSPH, shared::SOLVER_WCSPH}) {
        SCOPED_TRACE(++round);
        sim::SimulationSettings its = settings(solver);
        if (round > 2) { // and with all that passes may do besides
            its.options.xsph = its.options.confinement = true;
            its.params.xsph = 0.02f;
            its.params.vorticity_confinement = 0.1f;
            its.options.mixed_viscosity = true;
            its.params.viscosity[1] = 3.0f;
        }
        if (round > 3) {
            its = with_tension(its);
            its.options.implicit_viscosity = true;
            its.options.shifting = true;
            its.params.shifting = 1e-4f;
        }
        its.params.dt = solver == shared::SOLVER_WCSPH ? 2e-4f : 1e-3f;
        ParticleSet seen[2];
        for (const bool dusty : {false, true}) {
            ParticleSet start = lattice_state({10, 8, 10}, glm::vec3(0.25f, 0.025f, 0.25f));
            const std::size_t fluid = start.size();
            if (dusty) { // in the very place of the fluid
                const ParticleSet dust = crumbling(0.0);
                for (std::size_t i = 0; i < dust.size(); ++i) {
                    add_particle(start, dust.position[i] - glm::vec3(0.0f, 0.2f, 0.0f));
                    start.attributes.back() = shared::pack_attributes(shared::STATE_DUST, 2);
                    start.weight.back() = 0.0f;
                }
                start.release_time.assign(start.size(), 0.0f);
            }
            sim::Simulation simulation(context(), start, its);
            simulation.advance(40);
            seen[dusty ? 1 : 0] = simulation.download();
            EXPECT_EQ(count(seen[dusty ? 1 : 0], shared::STATE_FLUID), fluid);
        }
        const float rounding = its.options.implicit_viscosity ? 1e-5f : 0.0f; // of its sums over all that move
        for (std::size_t i = 0; i < seen[0].size(); ++i) {
            EXPECT_LE(glm::distance(seen[0].position[i], seen[1].position[i]), rounding) << "particle " << i;
            EXPECT_LE(glm::distance(seen[0].velocity[i], seen[1].velocity[i]), 10.0f * rounding);
        }
    }
}

TEST_F(DustTest, EndsWithItsLifeOrTheDomain)
{
    sim::SimulationSettings its = settings();
    its.dust->wind = {2.0f, 0.0f, 0.0f}; // half of it leaves before its life is over
    its.dust->response_time = 0.02f;
    const ParticleSet start = crumbling(0.1);
    sim::Simulation simulation(context(), start, its);
    std::size_t dead = 0;
    for (int portion = 0; portion < 40; ++portion) {
        simulation.advance(9);
        const ParticleSet now = simulation.download();
        EXPECT_EQ(count(now, shared::STATE_SOLID) + count(now, shared::STATE_DUST) + count(now, shared::STATE_DEAD),
                  start.size());
        EXPECT_GE(count(now, shared::STATE_DEAD), dead);
        dead = count(now, shared::STATE_DEAD);
        for (std::size_t i = 0; i < now.size(); ++i) {
            EXPECT_EQ(now.id[i], i);
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(now.position[i], glm::vec3(0.0f))) &&
                        glm::all(glm::lessThanEqual(now.position[i], glm::vec3(1.0f))));
        }
    }
    EXPECT_EQ(dead, start.size());
    EXPECT_EQ(simulation.particles().moving, 0u); // nor does a step go over the dead
}

} // namespace
} // namespace meltpoint
