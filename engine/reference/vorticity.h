#pragma once

#include <cstddef>
#include <vector>

#include "reference/cells.h"
#include "reference/forces.h"
#include "reference/state.h"

namespace meltpoint::reference {

/// Twins of the passes of sim/vorticity. The state has densities; boundary particles take no part.

/// Twin of sim/xsph.comp: what XSPH adds to the velocity of i, c sum_j 2 m_j / (rho_i + rho_j) (v_j - v_i) W_ij with
/// c = params.xsph, m/s (Monaghan 1989; Schechter & Bridson 2012, who smooth the velocity itself).
[[nodiscard]] VectorSum smoothing(const Settings& settings, const State& state, const Neighbors& neighbors,
                                  std::size_t i);

/// Twin of sim/vorticity.comp: the curl of the velocity, 1/s (Macklin & Müller 2013, equation 15).
[[nodiscard]] VectorSum vorticity(const Settings& settings, const State& state, const Neighbors& neighbors,
                                  std::size_t i);

/// Twin of sim/confinement.comp: epsilon N x omega_i with epsilon = params.vorticity_confinement, m/s^2 (Macklin &
/// Müller 2013, equation 16). N is the direction in which |omega| rises; shorter than 1 where it hardly does.
[[nodiscard]] glm::dvec3 confinement(const Settings& settings, const State& state, const Neighbors& neighbors,
                                     const std::vector<glm::dvec3>& vorticities, std::size_t i);

/// Adds to all velocities what XSPH does; nothing where params.xsph is 0.
void smooth_velocities(const Settings& settings, State& state, const Neighbors& neighbors);

/// Adds confinement to all accelerations; nothing where params.vorticity_confinement is 0.
void add_confinement(const Settings& settings, State& state, const Neighbors& neighbors);

} // namespace meltpoint::reference
