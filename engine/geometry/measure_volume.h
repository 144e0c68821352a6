#pragma once

#include "geometry/solid.h"
#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// How hard to try: the grid is refined from first_cells until the error is small enough or it has most_cells.
struct VolumeAccuracy {
    double error = 3e-4; ///< standard error over volume
    double first_cells = 320e3;
    double most_cells = 0x1p24;
};

/// Volume of a solid (m^3) by stratified sampling: two random points and their mirror images in each cell of a
/// grid over its box. By how much the two disagree gives the standard error; the grid is refined until it is small
/// enough (or there are no more cells, which only very thin shapes need).
[[nodiscard]] double measure_volume(const Solid& solid, const VolumeAccuracy& accuracy = {});

/// Of the region of winding number >= 1/2. For a closed mesh without self-intersections it agrees with signed_volume.
[[nodiscard]] double measure_volume(const TriangleMesh& mesh);

} // namespace meltpoint
