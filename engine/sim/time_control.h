#pragma once

#include <cstdint>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "shared/sph_params.h"
#include "shared/time_step.h"

namespace meltpoint::sim {

/// How long the steps are that the device chooses.
class TimeControl {
public:
    /// Starts as if a step of params.dt were behind it.
    TimeControl(const gpu::Context& context, const shared::SphParams& params);

    /// Whether the device chooses them; else every step takes params.dt.
    [[nodiscard]] bool adaptive() const { return adaptive_; }

    /// Writes the length of the next step to params, from the particles' velocities and accelerations; nothing where
    /// steps are fixed.
    void record(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles);

    /// Sets how much time the steps to come may take, s; infinity where they need not end at a certain time.
    void set_remaining(gpu::Commands& commands, float seconds);
    /// The steps that are surely needed for what remains: fewer would be too few however fast they grow. At least 1.
    [[nodiscard]] static std::uint32_t least_steps(const shared::TimeStep& state, float longest_dt, std::uint32_t most);

    /// shared::TimeStep.
    [[nodiscard]] const gpu::Buffer& state() const { return state_; }

private:
    bool adaptive_;
    gpu::Kernel fastest_;
    gpu::Kernel time_step_;
    gpu::Buffer state_;
};

} // namespace meltpoint::sim
