// What was solid takes on the volume of its fluid: against the twin, and without a kick.
#include "reference/volume_relaxation.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/random.h"
#include "shared/volume_relaxation.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class VolumeRelaxationTest : public GpuTest {
protected:
    static sim::SimulationSettings settings(std::uint32_t solver)
    {
        sim::SimulationSettings its = test_settings(shared::KERNEL_WENDLAND);
        its.options.solver = solver;
        its.options.still = true;
        its.params.gravity = glm::vec3(0.0f);
        its.params.dt = solver == shared::SOLVER_WCSPH ? 2e-4f : 1e-3f;
        return its;
    }

    /// A cube of ten particles an edge, of a solid whose volume is so many times its fluid's, that is free at
    /// `release`.
    static ParticleSet cube(float volume, float release)
    {
        ParticleSet set;
        const float pitch = test_spacing * std::cbrt(volume);
        for (int i = 0; i < 1000; ++i) {
            add_particle(set, glm::vec3(0.5f) + pitch * (glm::vec3(i % 10, i / 10 % 10, i / 100) - 4.5f));
            set.attributes.back() = shared::pack_attributes(shared::STATE_SOLID, 0);
            set.weight.back() = volume;
        }
        set.release_time.assign(set.size(), release);
        return set;
    }
};

TEST_F(VolumeRelaxationTest, StepsAreTheTwins)
{
    for (const std::uint32_t solver : {shared::SOLVER_WCSPH, shared::SOLVER_DFSPH, shared::SOLVER_PBF}) {
        ParticleSet start = cube(1.09f, std::numeric_limits<float>::infinity());
        Random random(5);
        for (std::size_t i = 0; i < start.size(); i += 2) {
            start.weight[i] = 0.75f + 0.6f * static_cast<float>(random.uniform());
            start.release_time[i] = 0.0f;
        }
        start.weight[2] = 1.0f + 1.005f * shared::VOLUME_TOLERANCE;
        sim::Simulation simulation(context(), start, settings(solver));
        simulation.advance(1);
        reference::State twin = reference::from_particle_set(simulation.download());
        twin.weight.assign(start.weight.begin(), start.weight.end());
        reference::relax_volumes(twin);
        for (int step = 0; step < 40; ++step) {
            simulation.advance(1);
            reference::relax_volumes(twin);
        }
        const ParticleSet now = simulation.download();
        for (std::size_t i = 0; i < now.size(); ++i) {
            ASSERT_NEAR(now.weight[i], twin.weight[i], 1e-5) << i;
            ASSERT_TRUE(i % 2 == 0 || now.weight[i] == 1.09f);
        }
        EXPECT_EQ(now.weight[2], 1.0f);
        EXPECT_GT(std::abs(now.weight[0] - start.weight[0]), 0.2f * std::abs(start.weight[0] - 1.0f));
    }
}

TEST_F(VolumeRelaxationTest, WhatIsFreedIsNotKicked)
{
    for (const float volume : {1000.0f / 917.0f, 1000.0f / 1100.0f}) { // as ice to water, and as wax
        sim::SimulationSettings its = settings(shared::SOLVER_WCSPH);
        sim::Simulation simulation(context(), cube(volume, 0.0f), its);
        // Later the cube grows: its corners move outward as fast as that takes.
        const float growth = std::max(1.0f / std::cbrt(volume) - 1.0f, 0.0f);
        const float way = growth * std::sqrt(3.0f) * 5.0f * test_spacing;
        const float swelling = 1.5f * way / (shared::VOLUME_RELAXATION_STEPS * its.params.dt);
        const float kick = 0.02f * its.params.speed_of_sound;
        float fastest = 0.0f;
        for (int portion = 0; portion < 30; ++portion) {
            simulation.advance(20);
            const ParticleSet now = simulation.download();
            for (std::size_t i = 0; i < now.size(); ++i) {
                ASSERT_EQ(shared::particle_state(now.attributes[i]), shared::STATE_FLUID);
                fastest = portion == 0 ? std::max(fastest, glm::length(now.velocity[i])) : fastest;
                ASSERT_LT(glm::length(now.velocity[i]), portion == 0 ? kick : std::max(kick, swelling)) << portion;
            }
        }
        RecordProperty(volume > 1.0f ? "ice" : "wax", std::to_string(fastest / its.params.speed_of_sound));
        for (const float weight : simulation.download().weight) {
            EXPECT_EQ(weight, 1.0f);
        }
    }
}

} // namespace
} // namespace meltpoint
