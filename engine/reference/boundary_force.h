#pragma once

#include <cstddef>
#include <vector>

#include "reference/cells.h"
#include "reference/forces.h"
#include "reference/state.h"

namespace meltpoint::reference {

/// Twins of sim/boundary_force.comp and sim/boundary_impulse.comp: what fluid does to boundary particle b, the reaction
/// to what it does to the fluid. Sums over fluid j include the images behind walls.

/// sum_j P_j s_b g_bj with g_bj = -grad W_bj. With P = p V^2 (N m^4) a force, N; with the impulses P = dt p V^2 of a
/// solve (N s m^4) an impulse, N s.
[[nodiscard]] VectorSum push_on_boundary(const Settings& settings, const State& state, const Neighbors& neighbors,
                                         const std::vector<double>& pressure_term, std::size_t b);

/// mu_b V_b sum_j V_j (v_j - v_b) L_bj, N: mu_b the friction of b's material.
[[nodiscard]] VectorSum friction_on_boundary(const Settings& settings, const State& state, const Neighbors& neighbors,
                                             std::size_t b);

/// p V^2 of every particle, 0 for boundary particles, N m^4.
[[nodiscard]] std::vector<double> pressure_terms(const State& state);

} // namespace meltpoint::reference
