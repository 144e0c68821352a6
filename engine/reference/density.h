#pragma once

#include <cstddef>

#include "reference/cells.h"
#include "reference/state.h"

namespace meltpoint::reference {

/// Twin of sim/density.comp. rho_i = m_i sum_j s_j W_ij in kg/m^3, the sum including i and images behind walls, s_j the
/// weight of j (Solenthaler & Pajarola 2008, equation 4; Akinci et al. 2012, equation 6).
[[nodiscard]] double density(const Settings& settings, const State& state, const Neighbors& neighbors, std::size_t i);

/// Equation of state: pressure in Pa at a density (kg/m^3) of a fluid of that rest density (kg/m^3), clamped at 0 if
/// params.clamp_pressure.
[[nodiscard]] double pressure(const shared::SphParams& params, double density, double rest_density);

/// Sets density and pressure of every particle, but not a pressure that is solved for; both are 0 for boundary
/// particles.
void update_density(const Settings& settings, State& state, const Neighbors& neighbors);

} // namespace meltpoint::reference
