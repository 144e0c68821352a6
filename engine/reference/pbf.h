#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "reference/cells.h"
#include "reference/dfsph.h"
#include "reference/forces.h"
#include "reference/state.h"

namespace meltpoint::reference {

/// Twins of the passes of sim/pbf (Macklin & Müller 2013, with masses; shared/pbf.h has the equations). A state's
/// positions are the predicted ones, `neighbors` theirs; `moved` is where the particles are in the present iteration.

/// Twin of sim/pbf_predict.comp: x += v dt, held off the walls.
void predict(const Settings& settings, State& state);

/// Twin of sim/pbf_move.comp: the moves (m) without what would bring particles too near to walls.
void hold_moves_off_walls(const Settings& settings, const State& state, std::vector<glm::dvec3>& moves);

/// The positions and the moves since.
[[nodiscard]] std::vector<glm::dvec3> moved_positions(const State& state, const std::vector<glm::dvec3>& moves);

/// What one particle's constraint is, and asks for. Twin of sim/pbf_residual.comp.
struct Constraint {
    double density = 0.0;            ///< kg/m^3
    double excess = 0.0;             ///< C: rho/rho0 - 1
    double impulse = 0.0;            ///< X, kg m^5
    double artificial = 0.0;         ///< A, kg m^5
    double impulse_per_excess = 0.0; ///< X is this times C, where C is to be acted upon
};
[[nodiscard]] Constraint constraint(const Settings& settings, const State& state, const Neighbors& neighbors,
                                    const std::vector<glm::dvec3>& moved, std::size_t i);

/// Twin of sim/pbf_correct.comp: what an iteration adds to the move of i, m.
[[nodiscard]] VectorSum position_correction(const Settings& settings, const State& state, const Neighbors& neighbors,
                                            const std::vector<glm::dvec3>& moved,
                                            const std::vector<Constraint>& constraints, std::size_t i);

/// All iterations: moves, which begin with what the accelerations do in a step; the densities of the state where they
/// lead, and the sum of dt^2 p over the iterations as its pressures.
SolveResult solve_positions(const Settings& settings, State& state, const Neighbors& neighbors,
                            std::vector<glm::dvec3>& moves);

/// Twin of sim/pbf_finish.comp: velocities, no faster than the speed cap, positions and pressures that the moves stand
/// for, and the watch. Returns how many particles the cap slowed down.
std::uint32_t finish(const Settings& settings, State& state, const std::vector<glm::dvec3>& moves);

/// One time step of params.dt. The state must have boundary weights (evaluate).
SolveResult pbf_step(const Settings& settings, State& state);

} // namespace meltpoint::reference
