#pragma once

#include <cstddef>

#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// What can be said of a mesh at once; its volume is MeshSolid::volume(), which takes longer.
struct MeshFacts {
    std::size_t triangles = 0;
    std::size_t boundary_edges = 0;    ///< edges that belong to exactly one triangle: zero for a closed mesh
    std::size_t nonmanifold_edges = 0; ///< edges that belong to more than two
    double area = 0.0;                 ///< m^2
};

/// The edges mean something only on a welded mesh.
[[nodiscard]] MeshFacts mesh_facts(const TriangleMesh& mesh);

} // namespace meltpoint
