#pragma once

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "reference/cells.h"
#include "reference/forces.h"
#include "reference/solve_result.h"
#include "reference/state.h"

namespace meltpoint::reference {

/// Twins of the passes of sim/implicit_viscosity (Weiler, Koschier, Brand & Bender 2018), in the terms of
/// shared/viscosity_solve.h: A v = v + dt K v / m. Particle i is fluid.

/// -dt K v / m of particle i, m/s, of the velocities v in m/s. A pair of fluid particles is pulled along its line;
/// boundary particles (their friction) and walls (params.wall_viscosity) drag along the difference of velocities, as
/// viscosity_acceleration and wall_viscosity_acceleration have it.
[[nodiscard]] VectorSum viscous_change(const Settings& settings, const State& state, const Neighbors& neighbors,
                                       const std::vector<glm::dvec3>& velocity, std::size_t i);

/// What a lid that moves adds to that, m/s: not of the matrix, but of the right side.
[[nodiscard]] glm::dvec3 lid_change(const Settings& settings, const State& state, std::size_t i);

/// The block of A of particle i, without its own images.
[[nodiscard]] glm::dmat3 viscosity_block(const Settings& settings, const State& state, const Neighbors& neighbors,
                                         std::size_t i);

/// The error of a solve from the sums over m r^2, m u^2 (u the change of velocity) and m v*^2.
[[nodiscard]] double viscosity_error(double residual, double change, double momentum);

/// A whole solve: changes the state's velocities and its viscous_acceleration, from which it starts. The state must
/// have densities and boundary weights.
SolveResult solve_viscosity(const Settings& settings, State& state, const Neighbors& neighbors);

} // namespace meltpoint::reference
