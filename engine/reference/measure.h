#pragma once

#include <glm/glm.hpp>

#include "reference/state.h"

namespace meltpoint::reference {

/// Sums over all particles in index order, so that they are the same on every machine.

[[nodiscard]] double total_mass(const State& state);     ///< kg
[[nodiscard]] double kinetic_energy(const State& state); ///< J
[[nodiscard]] glm::dvec3 momentum(const State& state);   ///< kg m/s
[[nodiscard]] double
momentum_magnitude(const State& state); ///< sum of m |v|, kg m/s: what momentum's error is small against
[[nodiscard]] glm::dvec3 center_of_mass(const State& state); ///< m
[[nodiscard]] double max_speed(const State& state);          ///< m/s

/// -m g . x summed, J: zero level at the origin.
[[nodiscard]] double potential_energy(const Settings& settings, const State& state);

} // namespace meltpoint::reference
