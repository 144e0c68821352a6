#pragma once

#include <span>
#include <vector>

#include "reference/cells.h"
#include "reference/state.h"
#include "shared/heat.h"

namespace meltpoint::reference {

/// degrees C, of a material's specific enthalpy in J/kg (shared/heat.h).
[[nodiscard]] double temperature(const shared::HeatMaterial& material, double enthalpy);

/// W/(m K): linear between solid and fluid while it melts.
[[nodiscard]] double conductivity(const shared::HeatMaterial& material, double enthalpy);

/// Twin of sim/temperature.comp and sim/conduction.comp: heat flows for one step of dt seconds. enthalpy: J/kg, by id
/// (Cleary & Monaghan 1999, equation 28).
void conduct(const Settings& settings, const shared::HeatParams& heat, const State& state, const Neighbors& neighbors,
             std::span<double> enthalpy, double dt);

/// The sum of m H over fluids and solids, J.
[[nodiscard]] double heat_content(const State& state, std::span<const double> enthalpy);

} // namespace meltpoint::reference
