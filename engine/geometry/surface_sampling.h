#pragma once

#include <cstddef>
#include <cstdint>

#include "geometry/point_cloud.h"
#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// Exactly `count` points, uniformly distributed over the surface: triangles by area from an alias table, then uniform
/// on the triangle by folding the unit square (Osada, Funkhouser, Chazelle & Dobkin 2002). The normal is interpolated
/// from the vertices where all three have one, else it is the triangle's. The mesh must be valid (validate()). Point i
/// depends on the seed and i alone: more points begin with the same ones, on any number of threads. More than 2^28
/// points are an Input error.
[[nodiscard]] PointCloud sample_surface_random(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed);

} // namespace meltpoint
