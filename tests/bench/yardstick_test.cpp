// The yardstick of `meltpoint bench` against the CPU reference in double precision: it may only be compared with the
// device if it computes the same. And the block of fluid that both are measured on.
#include "bench/yardstick.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "bench/block.h"
#include "reference/measure.h"
#include "reference/step.h"
#include "sim/simulation.h"
#include "support/fluid_states.h"

namespace meltpoint {
namespace {

struct Case {
    std::string name;
    std::uint32_t kernel;
    ParticleSet set;
    sim::SimulationSettings settings;
};

std::vector<Case> cases()
{
    std::vector<Case> all;
    for (const std::uint32_t kernel : {shared::KERNEL_PAPER, shared::KERNEL_WENDLAND}) {
        sim::SimulationSettings with_friction = test_settings(kernel);
        with_friction.params.wall_viscosity = 2.0f;
        sim::SimulationSettings some_walls = test_settings(kernel);
        some_walls.params.wall_mask = 0x26; // x max, y min, z max
        some_walls.params.state_equation = shared::STATE_EQUATION_LINEAR;
        some_walls.params.clamp_pressure = 0;
        const std::string name = kernel == shared::KERNEL_PAPER ? ", paper" : ", Wendland";
        all.push_back({"splash" + name, kernel, splash_state(2), with_friction});
        all.push_back({"floor" + name, kernel, lattice_state({20, 5, 20}, glm::vec3(0.5f * test_spacing)), some_walls});
        all.push_back(
            {"random" + name, kernel, random_state(1501, glm::vec3(0.01f), glm::vec3(0.6f), 1), with_friction});
    }
    return all;
}

TEST(Yardstick, DensityIsTheReferences)
{
    ASSERT_EQ(bench::Yardstick::missing_feature(), "");
    for (const Case& it : cases()) {
        SCOPED_TRACE(it.name);
        const shared::SphParams params = sim::complete_params(it.settings.params, it.set.size());
        bench::Yardstick yardstick(it.set, params, it.kernel, 2);
        yardstick.evaluate_density();
        reference::State twin = reference::from_particle_set(it.set);
        reference::evaluate({.kernel = it.kernel, .params = params}, twin);
        const ParticleSet found = yardstick.particles();
        for (std::size_t i = 0; i < found.size(); ++i) {
            ASSERT_NEAR(static_cast<double>(found.density[i]), twin.density[i], 1e-5 * twin.density[i]) << i;
        }
    }
}

TEST(Yardstick, StepsAreTheReferences)
{
    for (const Case& it : cases()) {
        SCOPED_TRACE(it.name);
        const shared::SphParams params = sim::complete_params(it.settings.params, it.set.size());
        const reference::Settings settings{.kernel = it.kernel, .params = params};
        reference::State twin = reference::from_particle_set(it.set);
        reference::evaluate(settings, twin);
        ParticleSet start = it.set;
        for (std::size_t i = 0; i < start.size(); ++i) {
            start.acceleration[i] = glm::vec3(twin.acceleration[i]);
        }
        bench::Yardstick yardstick(start, params, it.kernel, 2);
        yardstick.evaluate_density(); // moves nothing
        constexpr std::uint32_t steps = 5;
        yardstick.advance(steps);
        for (std::uint32_t step = 0; step < steps; ++step) {
            reference::step(settings, twin);
        }
        const ParticleSet found = yardstick.particles();
        double fastest = 0.0;
        for (const glm::dvec3& v : twin.velocity) {
            fastest = std::max(fastest, glm::length(v));
        }
        for (std::size_t i = 0; i < found.size(); ++i) {
            ASSERT_LT(glm::length(glm::dvec3(found.position[i]) - twin.position[i]), 1e-5) << i;
            ASSERT_LT(glm::length(glm::dvec3(found.velocity[i]) - twin.velocity[i]), 1e-3 * fastest) << i;
        }
    }
}

TEST(Yardstick, ThreadsOnlyShareTheWork)
{
    const Case it = cases().front();
    const shared::SphParams params = sim::complete_params(it.settings.params, it.set.size());
    const auto run = [&](std::uint32_t threads) {
        bench::Yardstick yardstick(it.set, params, it.kernel, threads);
        yardstick.advance(5);
        return yardstick.particles().position;
    };
    const std::vector<glm::vec3> alone = run(1);
    const std::vector<glm::vec3> shared = run(3);
    for (std::size_t i = 0; i < alone.size(); ++i) {
        EXPECT_LT(glm::length(alone[i] - shared[i]), 1e-5f) << i; // the order within a cell may differ
    }
}

TEST(BenchBlock, HasExactlyTheParticlesAskedFor)
{
    for (const std::uint32_t count : {64u, 1000u, 1001u, 8000u}) {
        const Scene scene = bench::block_scene(count);
        const ParticleSet set = bench::block_particles(count, 1);
        ASSERT_EQ(set.size(), count);
        const float d = scene.particles.spacing;
        EXPECT_FLOAT_EQ(scene.particles.support_ratio, 2.05f);
        EXPECT_FLOAT_EQ(scene.domain.max.x - scene.domain.min.x, 3.0f);
        float largest_jitter = 0.0f;
        for (const glm::vec3& x : set.position) {
            const glm::vec3 cell = x / d - 0.5f;
            const glm::vec3 jitter = glm::abs(cell - glm::round(cell));
            largest_jitter = std::max({largest_jitter, jitter.x, jitter.y, jitter.z});
            EXPECT_TRUE(glm::all(glm::lessThan(x, glm::vec3(1.0f))));
        }
        EXPECT_LT(largest_jitter, 0.0501f);
        EXPECT_GT(largest_jitter, 0.04f);
        EXPECT_EQ(bench::block_particles(count, 1).position, set.position);
        EXPECT_NE(bench::block_particles(count, 2).position, set.position);
    }
}

} // namespace
} // namespace meltpoint
