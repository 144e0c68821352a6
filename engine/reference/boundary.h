#pragma once

#include <cstddef>

#include "reference/cells.h"
#include "reference/state.h"

namespace meltpoint::reference {

/// Twin of sim/boundary_weight.comp. The weight of boundary particle b: V_b / d^3 with V_b = 1 / sum_k W_bk over
/// boundary particles, itself and images behind walls included (Akinci et al. 2012, equation 4). So a surface has the
/// same effect however densely it is sampled, or unevenly.
[[nodiscard]] double boundary_weight(const Settings& settings, const State& state, const Neighbors& neighbors,
                                     std::size_t b);

/// Sets the weight of every boundary particle.
void update_boundary_weights(const Settings& settings, State& state, const Neighbors& neighbors);

} // namespace meltpoint::reference
