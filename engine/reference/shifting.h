#pragma once

#include <cstddef>

#include "reference/cells.h"
#include "reference/forces.h"
#include "reference/state.h"

namespace meltpoint::reference {

/// Twin of sim/shift.comp (Lind, Xu, Stansby & Rogers 2012). What shifting wants to move fluid particle i by, m: -D dt
/// grad C_i, grad C_i = sum_j V_j (1 + 0.2 (W_ij / W(d))^4) grad W_ij, D = params.shifting.
[[nodiscard]] VectorSum wanted_shift(const Settings& settings, const State& state, const Neighbors& neighbors,
                                     std::size_t i);

/// The same, no farther than it may be.
[[nodiscard]] glm::dvec3 shift(const Settings& settings, const State& state, const Neighbors& neighbors, std::size_t i);

/// Moves all fluid particles; nothing where params.shifting is 0. The state has densities and boundary weights.
void shift_particles(const Settings& settings, State& state, const Neighbors& neighbors);

} // namespace meltpoint::reference
