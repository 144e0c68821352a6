#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "geometry/solid.h"

namespace meltpoint {

/// Whole cells that cover a solid and more.
struct CellsNear {
    CellGrid grid;
    std::vector<glm::uvec3> cells;
};

/// The cells of about the given edge in which, or nearer than `reach` to which, there are points of the solid (m).
/// Their grid fits the solid's box.
[[nodiscard]] CellsNear cells_near(const Solid& solid, double edge, double reach);

/// Space just outside of a solid, in pieces.
struct OutsidePoints {
    std::vector<glm::vec3> positions; ///< m
    std::vector<double> volumes;      ///< m^3
};

/// Pieces with edges of at most `edge`, at least all that are nearer than `reach` to the solid (m). Their grid fits the
/// solid's box, so that boxes have their exact faces; across other surfaces pieces are counted, and centered, in
/// eighths.
[[nodiscard]] OutsidePoints points_outside(const Solid& solid, double edge, double reach);

} // namespace meltpoint
