#include "sim/time_control.h"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "gpu/transfer.h"
#include "spirv/sim/fastest.comp.h"
#include "spirv/sim/time_step.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;

TimeControl::TimeControl(const gpu::Context& context, const shared::SphParams& params)
    : adaptive_(params.adaptive_dt != 0), fastest_(context, "fastest", sim_fastest_comp),
      time_step_(context, "time_step", sim_time_step_comp),
      state_(gpu::make_buffer<shared::TimeStep>(context, 1, "time step"))
{
    const shared::TimeStep start{.fastest = 0, .limit = params.dt, .remaining = 0.0f, .elapsed = 0.0f};
    gpu::upload<shared::TimeStep>(context, state_, {&start, 1});
}

void TimeControl::record(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles)
{
    if (!adaptive_) {
        return;
    }
    const gpu::Scope scope(commands, "time step");
    const std::uint32_t invocations =
        (particles.moving + shared::PARTICLES_PER_SPEED - 1) / shared::PARTICLES_PER_SPEED;
    commands.dispatch(fastest_, invocations, gpu::NoPush{},
                      {read(params), read(particles.velocity), read(particles.acceleration), read(particles.attributes),
                       read_write(state_)});
    commands.dispatch(time_step_, 1, gpu::NoPush{}, {read_write(params), read_write(state_)});
}

void TimeControl::set_remaining(gpu::Commands& commands, float seconds)
{
    commands.fill(state_, std::bit_cast<std::uint32_t>(seconds), sizeof(float), offsetof(shared::TimeStep, remaining));
    commands.fill(state_, 0, sizeof(float), offsetof(shared::TimeStep, elapsed));
}

std::uint32_t TimeControl::least_steps(const shared::TimeStep& state, float longest_dt, std::uint32_t most)
{
    float limit = state.limit;
    float remaining = state.remaining;
    std::uint32_t steps = 0;
    do {
        limit = std::min(longest_dt, limit * shared::TIME_STEP_GROWTH);
        remaining -= shared::landing_step(limit, remaining);
        ++steps;
    } while (remaining > 0.0f && steps < most);
    return steps;
}

} // namespace meltpoint::sim
