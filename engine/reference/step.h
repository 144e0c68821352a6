#pragma once

#include "reference/state.h"

namespace meltpoint::reference {

/// Density, pressure and acceleration of the particles where they are. Call it once before the first step.
void evaluate(const Settings& settings, State& state);

/// One time step of params.dt: half a kick, drift, density and forces, half a kick.
void step(const Settings& settings, State& state);

} // namespace meltpoint::reference
