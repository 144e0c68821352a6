#pragma once

#include <vector>

#include "reference/state.h"

namespace meltpoint::reference {

/// Twin of sim/exposure.comp: of each solid particle the normal of its exposed surface, and in w that surface's area in
/// m^2 (in the plane m); zero of those inside, and of all others. Of the settings, the support radius does not matter.
[[nodiscard]] std::vector<glm::dvec4> exposure(const Settings& settings, const State& state);

/// The same without LEAST_EXPOSURE: what is left inside are rounding and the disorder of particles.
[[nodiscard]] std::vector<glm::dvec4> exposure_of_all(const Settings& settings, const State& state);

} // namespace meltpoint::reference
