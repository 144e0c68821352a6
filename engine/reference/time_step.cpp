// Courant, Friedrichs & Lewy 1928; Monaghan, "Smoothed Particle Hydrodynamics", Annu. Rev. Astron. Astrophys. 30, 1992
// (the bound of the fastest particle and sound together).
#include "reference/time_step.h"

#include <algorithm>
#include <cmath>

namespace meltpoint::reference {

double fastest_speed(const Settings& settings, const State& state)
{
    double fastest = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (!is_boundary(state, i)) {
            const glm::dvec3 later =
                state.velocity[i] + static_cast<double>(settings.params.dt) * state.acceleration[i];
            fastest = std::max({fastest, glm::length(state.velocity[i]), glm::length(later)});
        }
    }
    return fastest;
}

StepLength next_step(const shared::SphParams& params, double fastest, double limit_before, double remaining)
{
    const double speed = static_cast<double>(params.cfl_speed) + fastest;
    const double grown = limit_before * static_cast<double>(shared::TIME_STEP_GROWTH);
    double limit = std::min(static_cast<double>(params.longest_dt), grown);
    if (speed > 0.0) {
        limit = std::min(limit, static_cast<double>(params.cfl_length) / speed);
    }
    limit = std::max(limit, static_cast<double>(params.shortest_dt));
    const double steps = remaining / (limit * (1.0 + static_cast<double>(shared::LANDING_TOLERANCE)));
    if (steps <= 1.0) {
        return {limit, remaining};
    }
    return {limit, steps < 1e6 ? remaining / (std::floor(steps) + 1.0) : limit};
}

} // namespace meltpoint::reference
