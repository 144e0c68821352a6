#pragma once

#include "geometry/solid.h"
#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// Volume of a solid (m^3) by stratified sampling: two random points and their mirror images in each cell of a
/// grid over its box. By how much the two disagree gives the standard error; the grid is refined from 320,000 cells
/// until it is at most 0.03 % (or 2^24 are reached, which only very thin shapes need).
[[nodiscard]] double measure_volume(const Solid& solid);

/// Of the region of winding number >= 1/2. For a closed mesh without self-intersections it agrees with signed_volume.
[[nodiscard]] double measure_volume(const TriangleMesh& mesh);

} // namespace meltpoint
