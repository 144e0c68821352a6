#pragma once

#include <cstddef>
#include <span>

#include <glm/glm.hpp>

#include "reference/state.h"
#include "shared/hydraulic.h"

namespace meltpoint::reference {

/// What flow has done to each particle, all by id.
struct Damage {
    std::span<const double> strength; ///< 1 of what is usual
    std::span<double> done;           ///< D, 0 to 1
    std::span<double> rate;           ///< dD/dt, 1/s, from the last look on
};

/// Twin of sim/scour.comp: `seconds` at the rates of the last look, and the rates from now on. exposure
/// (reference/exposure.h) is of each particle.
void scour(const Settings& settings, const shared::HydraulicParams& hydraulic, const State& state,
           std::span<const glm::dvec4> exposure, Damage damage, double seconds);

/// Twin of sim/deposit.comp: sediment that has rested on something long enough is solid again, `seconds` after the last
/// look. How many particles that are.
std::size_t deposit(const Settings& settings, const shared::HydraulicParams& hydraulic, State& state,
                    std::span<double> damage, double seconds);

/// Twin of sim/detach.comp: solids that are worn away, or will be `ahead` (s) from now, turn into fluid. How many
/// they are.
std::size_t detach(const shared::HydraulicParams& hydraulic, State& state, Damage damage, double ahead);

} // namespace meltpoint::reference
