#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gpu/context.h"
#include "particles/particle_set.h"
#include "sim/simulation.h"

namespace meltpoint::bench {

struct Plan {
    std::vector<std::uint32_t> tiles; ///< particles an invocation; 0 is the device's own
    std::uint32_t warm_up = 100;      ///< steps before the measurement
    std::uint32_t steps = 70;         ///< measured, in up to seven portions
    bool own_steps = false; ///< as long as the scene's, which may be the device's choice: without the yardstick
};

/// Steps of one tile size, and of the yardstick beside it in the same run.
struct Result {
    std::uint32_t particles = 0;
    std::uint32_t tile = 0;
    double neighbors = 0.0; ///< mean, within the support radius, a particle itself not counted
    std::uint32_t steps = 0;
    double step_ms = 0.0;
    double dt = 0.0;                                    ///< s, mean of the measured steps
    double density_error = 0.0;                         ///< mean of max(0, rho/rho0 - 1) after them
    double iterations = 0.0;                            ///< of a density solve, mean; 0 where nothing is solved for
    std::vector<std::pair<std::string, double>> passes; ///< ms a step
    std::uint64_t bytes = 0;                            ///< of device memory
    std::optional<double> yardstick_step_ms;            ///< where the yardstick can do the scene on this processor

    [[nodiscard]] double simulated_seconds_per_second() const { return dt / step_ms * 1e3; }
    [[nodiscard]] double particle_steps_per_second() const { return particles / step_ms * 1e3; }
    /// Pairs of a particle and a neighbor within its support radius; each step visits them once for density and once
    /// for forces, and counts them once here.
    [[nodiscard]] double pair_visits_per_second() const { return particle_steps_per_second() * neighbors; }
    [[nodiscard]] std::optional<double> speedup() const
    {
        return yardstick_step_ms ? std::optional(*yardstick_step_ms / step_ms) : std::nullopt;
    }
};

/// Mean of max(0, rho/rho0 - 1) over fluid.
[[nodiscard]] double mean_density_error(const ParticleSet& set, const shared::SphParams& params);

/// Runs the warm-up, then the simulations with each tile size and the yardstick in turns, each a portion of the steps,
/// and takes medians over the portions.
///
/// Milliseconds are those of bench/clock.h, of the yardstick CPU time. The times
/// of the passes come from the device's timestamps, of more steps after the measured ones; on software devices they are
/// scaled to add up to the step.
///
/// Throws Runtime when yardstick and device disagree about density, center of mass or kinetic energy: then they do not
/// compute the same, and the comparison would mean nothing.
[[nodiscard]] std::vector<Result> measure(const gpu::Context& context, const ParticleSet& initial,
                                          const sim::SimulationSettings& settings, const Plan& plan);

} // namespace meltpoint::bench
