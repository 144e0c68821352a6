#pragma once

#include "reference/state.h"
#include "shared/time_step.h"

namespace meltpoint::reference {

/// Twin of sim/fastest.comp: the largest speed (m/s) that a fluid particle has, or will have after another
/// params.dt of its acceleration. 0 without fluid.
[[nodiscard]] double fastest_speed(const Settings& settings, const State& state);

/// How long a step may be, and is.
struct StepLength {
    double limit =
        0.0; ///< s: by the CFL bound, params.longest_dt, params.shortest_dt and what the step before might have been
    double dt = 0.0; ///< s: no longer, and so that equal steps end where `remaining` does
};
/// Twin of sim/time_step.comp: the next step. limit_before and remaining in seconds.
[[nodiscard]] StepLength next_step(const shared::SphParams& params, double fastest, double limit_before,
                                   double remaining);

} // namespace meltpoint::reference
