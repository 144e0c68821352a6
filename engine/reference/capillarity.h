#pragma once

#include <cstddef>
#include <vector>

#include "reference/cells.h"
#include "reference/forces.h"
#include "reference/state.h"

namespace meltpoint::reference {

/// Twins of the passes of sim/capillarity, steps 1 to 3 of shared/capillarity.h (Brackbill, Kothe & Zemach 1992; Morris
/// 2000). The state has densities and boundary weights.

/// Where the surface is, as one particle sees it. All is zero of boundary particles and of fluids without tension.
struct SurfaceNormal {
    glm::dvec3 gradient{0.0}; ///< n_i, 1/m: points into the fluid; turned into the plane of a solid near by
    glm::dvec3 normal{0.0};   ///< what curvature is taken of, 1/m: turned to the contact angle
    double magnitude = 0.0;   ///< sum of the absolute values of n_i's terms
    double sigma = 0.0;       ///< N/m, of its fluid
};

/// Twin of sim/surface_normal.comp.
[[nodiscard]] SurfaceNormal surface_normal(const Settings& settings, const State& state, const Neighbors& neighbors,
                                           std::size_t i);

/// Twin of sim/smooth_normal.comp: sum_j n_j W_ij / sum_j W_ij, j = i included, over fluids with tension; 1/m.
/// `normals` and `sigma` are of all particles.
[[nodiscard]] VectorSum smooth_normal(const Settings& settings, const State& state, const Neighbors& neighbors,
                                      const std::vector<glm::dvec3>& normals, const std::vector<double>& sigma,
                                      std::size_t i);

/// Twin of sim/capillarity.comp: the acceleration by tension, by the repulsion of crowded pairs and by the drag at the
/// surface, m/s^2, of a fluid with tension. `normals` are smoothed.
[[nodiscard]] VectorSum capillary_acceleration(const Settings& settings, const State& state, const Neighbors& neighbors,
                                               const std::vector<SurfaceNormal>& surface,
                                               const std::vector<glm::dvec3>& normals, std::size_t i);

/// Whether any fluid has tension.
[[nodiscard]] bool has_tension(const Settings& settings);

/// Adds tension to all accelerations; nothing where no fluid has any.
void add_capillarity(const Settings& settings, State& state, const Neighbors& neighbors);

} // namespace meltpoint::reference
