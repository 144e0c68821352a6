// The steps that the device chooses, against their twin; and that they end where the host wants them to.
#include "sim/time_control.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "conformance/device.h"
#include "core/error.h"
#include "reference/time_step.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class TimeControl : public GpuTest {
protected:
    static sim::SimulationSettings settings()
    {
        sim::SimulationSettings settings = test_settings(shared::KERNEL_WENDLAND);
        settings.params.adaptive_dt = 1;
        settings.params.cfl_length = 0.03f;
        settings.params.cfl_speed = 40.0f;
        settings.params.longest_dt = 1e-3f;
        settings.params.shortest_dt = 2e-6f;
        settings.params.longest_move = 0.03f;
        return settings;
    }

    static ParticleSet moving_particles(float speed)
    {
        ParticleSet set = random_state(1001, glm::vec3(0.3f), glm::vec3(0.7f), 5);
        for (glm::vec3& v : set.velocity) {
            v *= speed;
        }
        set.velocity[700] = glm::vec3(0.0f, 0.0f, 2.0f * speed);
        set.velocity[20] = glm::vec3(0.0f);
        set.acceleration[20] = glm::vec3(0.0f, -1e5f * speed, 0.0f); // the fastest is only about to be
        add_boundary_particle(set, glm::vec3(0.1f));
        set.velocity.back() = glm::vec3(1e6f); // does not count
        return set;
    }

    struct Chosen {
        float dt;
        float speed_limit;
        shared::TimeStep state;
    };
    /// The step that the device chooses after one that might have been limit_before long.
    Chosen choose(const ParticleSet& set, float limit_before, float remaining)
    {
        conformance::Device device(context(), set, settings());
        const shared::TimeStep start{.fastest = 0, .limit = limit_before, .remaining = remaining, .elapsed = 1.0f};
        gpu::upload<shared::TimeStep>(context(), device.time.state(), {&start, 1});
        device.run([&] { device.time.record(device.commands, device.params_buffer, device.particles); });
        const auto params = gpu::download<shared::SphParams>(context(), device.params_buffer, 1)[0];
        return {params.dt, params.speed_limit, gpu::download<shared::TimeStep>(context(), device.time.state(), 1)[0]};
    }
};

TEST_F(TimeControl, StepsAreTheTwins)
{
    const float infinite = std::numeric_limits<float>::infinity();
    for (const float speed : {0.0f, 1.0f, 30.0f, 1000.0f, 1e5f}) {
        const ParticleSet set = moving_particles(speed);
        const reference::Settings twin = conformance::reference_settings(settings().params, settings());
        const double fastest = reference::fastest_speed(twin, reference::from_particle_set(set));
        EXPECT_NEAR(fastest, 20.0 * static_cast<double>(speed), 1e-3 * static_cast<double>(speed));
        for (const auto& [before, remaining] : {std::pair{1.0f, infinite},
                                                {1e-4f, infinite},
                                                {1.0f, 1.5e-4f},
                                                {1.0f, 1.2e-3f},
                                                {2e-4f, 2e-4f},
                                                {2e-4f, 4e-4f}}) {
            const Chosen found = choose(set, before, remaining);
            const reference::StepLength expected = reference::next_step(
                settings().params, fastest, static_cast<double>(before), static_cast<double>(remaining));
            SCOPED_TRACE(testing::Message()
                         << "speed " << speed << ", before " << before << ", remaining " << remaining);
            EXPECT_NEAR(static_cast<double>(found.dt), expected.dt, 1e-6 * expected.dt);
            EXPECT_NEAR(static_cast<double>(found.state.limit), expected.limit, 1e-6 * expected.limit);
            EXPECT_FLOAT_EQ(found.speed_limit * found.dt, settings().params.longest_move);
            EXPECT_FLOAT_EQ(found.state.elapsed, 1.0f + found.dt);
            EXPECT_EQ(found.state.remaining, remaining - found.dt);
            EXPECT_EQ(found.state.fastest, 0u);
        }
    }
}

TEST_F(TimeControl, ShorterLimitsNeedNoFewerSteps)
{
    // So the host may submit so many steps without seeing the times in between.
    Random random(3);
    for (int run = 0; run < 500; ++run) {
        const auto limit = static_cast<float>(std::pow(10.0, -4.0 * random.uniform()));
        const auto remaining = static_cast<float>(random.uniform());
        shared::TimeStep state{.fastest = 0, .limit = limit, .remaining = remaining, .elapsed = 0.0f};
        const std::uint32_t promised = sim::TimeControl::least_steps(state, 0.3f, 100000);
        const float fluid_limit =
            limit * static_cast<float>((0.5 + 20.0 * random.uniform())); // of its fastest particle
        std::uint32_t steps = 0;
        while (state.remaining > 0.0f) {
            state.limit = std::min({0.3f, state.limit * shared::TIME_STEP_GROWTH, fluid_limit});
            state.remaining -= shared::landing_step(state.limit, state.remaining);
            ++steps;
        }
        EXPECT_GE(steps, promised);
        EXPECT_EQ(state.remaining, 0.0f);
    }
}

TEST_F(TimeControl, RunsEndAtTheTimeAskedFor)
{
    for (const std::uint32_t solver : {shared::SOLVER_WCSPH, shared::SOLVER_DFSPH, shared::SOLVER_PBF}) {
        // Free fall, in which the time shows.
        ParticleSet set;
        add_particle(set, glm::vec3(0.5f, 0.9f, 0.5f));
        sim::SimulationSettings fall = settings();
        fall.options.solver = solver;
        sim::Simulation simulation(context(), set, fall);
        double time = 0.0;
        std::uint64_t steps = 0;
        for (const double seconds : {0.0, 0.0123, 1e-5, 1.0 / 60.0, 0.1}) {
            simulation.advance_by(seconds);
            time += seconds;
            EXPECT_EQ(simulation.time(), time);
            EXPECT_GE(simulation.step() - steps, static_cast<std::uint64_t>(std::ceil(seconds / 1e-3)));
            EXPECT_LE(simulation.step() - steps, static_cast<std::uint64_t>(std::ceil(seconds / 5e-4)) + 10);
            steps = simulation.step();
        }
        EXPECT_NEAR(static_cast<double>(simulation.download().velocity[0].y), -9.81 * time, 1e-5);
        simulation.advance(7);
        EXPECT_EQ(simulation.step(), steps + 7);
        EXPECT_NEAR(static_cast<double>(simulation.download().velocity[0].y), -9.81 * simulation.time(), 1e-5);
        EXPECT_GT(simulation.time(), time + 7 * 0.2e-3);
    }
}

TEST_F(TimeControl, ASpeedOutOfAllBoundsIsReportedNotWaitedFor)
{
    for (const std::uint32_t solver : {shared::SOLVER_WCSPH, shared::SOLVER_DFSPH}) {
        ParticleSet set;
        add_particle(set, glm::vec3(0.5f));
        set.velocity[0] = glm::vec3(1e7f, 0.0f, 0.0f);
        sim::SimulationSettings fast = settings();
        fast.options.solver = solver;
        sim::Simulation simulation(context(), set, fast);
        try {
            simulation.advance_by(0.1);
            ADD_FAILURE() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::Runtime);
            EXPECT_NE(std::string(error.what()).find("faster than the time step allows"), std::string::npos);
        }
    }
}

TEST_F(TimeControl, FixedStepsEndWithinHalfAStep)
{
    ParticleSet set;
    add_particle(set, glm::vec3(0.5f));
    sim::SimulationSettings fixed = settings();
    fixed.params.adaptive_dt = 0;
    fixed.params.dt = 1e-3f;
    sim::Simulation simulation(context(), set, fixed);
    for (int frame = 1; frame <= 10; ++frame) {
        simulation.advance_by(1.0 / 60.0);
        EXPECT_NEAR(simulation.time(), frame / 60.0, 0.5001e-3);
    }
}

} // namespace
} // namespace meltpoint
