#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reference/cells.h"
#include "reference/forces.h"
#include "reference/solve_result.h"
#include "reference/state.h"
#include "shared/solve.h"

namespace meltpoint::reference {

/// Twins of the passes of sim/dfsph (Bender & Koschier 2017, in the number density form of shared/sph_params.h). With
/// g_ij = -grad W_ij, n_i = sum_j s_j W_ij and the impulses P_i = dt p_i V_i^2 (kg m^4/s), pressure changes velocities
/// by sum_j (P_i s_j + P_j s_i) g_ij / m_i. Boundary particles have no impulse, and do not move.

/// alpha_i of sim/density.comp, kg m^8: minus the impulse of particle i that changes the rate of n_i by one.
[[nodiscard]] double jacobi_diagonal(const Settings& settings, const State& state, const Neighbors& neighbors,
                                     std::size_t i);

/// Twin of sim/dfsph_correct.comp: what the impulses add to the velocity of i, m/s.
[[nodiscard]] VectorSum velocity_correction(const Settings& settings, const State& state, const Neighbors& neighbors,
                                            const std::vector<double>& impulse, std::size_t i);

/// A sum and the sum of its terms' absolute values.
struct ScalarSum {
    double value = 0.0;
    double magnitude = 0.0;
};

/// What a solve is to take away: of the divergence solve dt drho/dt / rho0, of the density solve rho/rho0 - 1 plus
/// that, where it is positive times shared::density_share, with the velocities given (m/s). Twin of the sums of
/// sim/dfsph_residual.comp.
[[nodiscard]] ScalarSum excess(const Settings& settings, const State& state, const Neighbors& neighbors,
                               const std::vector<glm::dvec3>& velocity, std::uint32_t solve, std::size_t i);

/// The next iterate of an impulse, kg m^4/s: a relaxed Jacobi step that never pulls.
[[nodiscard]] double next_impulse(const Settings& settings, const State& state, double diagonal, double excess,
                                  double impulse, std::size_t i);

/// An iterate with momentum: on beyond the step from the one before (Nesterov 1983).
[[nodiscard]] double with_momentum(double impulse, double before, double momentum);

/// What a solve starts from: a part of what the step before has found, where there is anything to take away.
/// warm_start: the impulse of the last divergence solve, or dt times that of the last density solve.
[[nodiscard]] double first_impulse(const Settings& settings, double excess, double warm_start, std::uint32_t solve);

/// By shared::SOLVE_*, one number a particle in id order: what first_impulse starts from.
using WarmStarts = std::array<std::vector<double>, shared::SOLVES>;

/// What the impulses of both solves of a step come to as a pressure, Pa; 0 of boundary particles. Twin of
/// sim/drift.comp.
[[nodiscard]] double solved_pressure(const Settings& settings, const State& state, const WarmStarts& warm_starts,
                                     std::size_t i);

/// A whole solve: changes the state's velocities, and leaves in warm_start the impulses that have changed them. Its
/// error is the mean of the positive excesses of fluid particles. Ends as sim/dfsph_residual.comp.
SolveResult solve(const Settings& settings, State& state, const Neighbors& neighbors, std::uint32_t solve,
                  std::vector<double>& warm_start);

/// What the solves of a step took, by shared::SOLVE_*.
using DfsphStep = std::array<SolveResult, shared::SOLVES>;

/// One time step of params.dt: velocities without divergence, other forces, velocities that keep the density, drift.
/// The state must have boundary weights (evaluate).
DfsphStep dfsph_step(const Settings& settings, State& state, WarmStarts& warm_starts);

} // namespace meltpoint::reference
