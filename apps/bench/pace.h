#pragma once

#include "gpu/context.h"
#include "particles/particle_set.h"
#include "sim/simulation.h"

namespace meltpoint::bench {

/// How solvers compare: over the same simulated time, whatever their steps.
struct Pace {
    double simulated_seconds_per_second = 0.0;
    double density_error = 0.0; ///< max(0, rho/rho0 - 1), mean over fluid and time
    double dt = 0.0;            ///< s, mean
    double iterations = 0.0;    ///< of a density solve, mean; 0 where nothing is solved for
};

/// Runs for so many simulated seconds; the density is looked at in equal intervals. Times are those of bench/clock.h,
/// of the steps alone.
[[nodiscard]] Pace measure_pace(const gpu::Context& context, const ParticleSet& initial,
                                const sim::SimulationSettings& settings, double seconds);

} // namespace meltpoint::bench
