#pragma once

#include <cstddef>
#include <span>

#include <glm/glm.hpp>

#include "reference/state.h"
#include "shared/heat.h"
#include "shared/melting.h"

namespace meltpoint::reference {

/// Twin of sim/warm.comp: what sun and air give to solids in `seconds` of heat. exposure (reference/exposure.h) and
/// visibility (reference/visibility.h) are of each particle, enthalpy is in J/kg by id.
void warm(const Settings& settings, const shared::HeatParams& heat, const shared::MeltingParams& melting,
          const State& state, std::span<const glm::dvec4> exposure, std::span<const double> visibility,
          std::span<double> enthalpy, double seconds);

/// Twin of sim/melt.comp: solids whose latent heat is complete, or will be when they have got `ahead` times as much as
/// since the last look, turn into fluid. before: J/kg, by id, at that look. How many they are.
std::size_t melt(const shared::HeatParams& heat, const shared::MeltingParams& melting, State& state,
                 std::span<const double> enthalpy, std::span<double> before, double ahead);

/// Twin of sim/freeze.comp: fluid that has no latent heat left is solid where a solid or collider is near. How many
/// particles that are.
std::size_t freeze(const Settings& settings, State& state, std::span<const double> enthalpy);

} // namespace meltpoint::reference
