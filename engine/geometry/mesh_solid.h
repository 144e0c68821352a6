#pragma once

#include <tbb/collaborative_call_once.h>

#include "geometry/solid.h"
#include "geometry/triangle_mesh.h"
#include "geometry/winding_number.h"

namespace meltpoint {

/// Cones over the holes of a mesh: for each group of connected boundary edges, triangles from the edges to their
/// middle, oriented so that mesh and cones together are closed. Edges count with the direction in which triangles use
/// them, so that any triangle soup can be closed.
[[nodiscard]] TriangleMesh boundary_cones(const TriangleMesh& mesh);

/// Where the winding number of a mesh is at least 1/2.
///
/// w = w_closed - w_cones, where w_closed, of mesh and cones together, is a whole number that changes only across a
/// triangle, and w_cones costs little: that makes masks cheap.
class MeshSolid final : public Solid {
public:
    /// The mesh must be valid (validate()), and is best welded: edges that only seem open cost time.
    explicit MeshSolid(const TriangleMesh& mesh);

    [[nodiscard]] Aabb bounds() const override { return bounds_; }

    /// Measured: see measure_volume(const Solid&).
    [[nodiscard]] double volume() const override;

    [[nodiscard]] bool contains(const glm::dvec3& point) const override;
    [[nodiscard]] CellMask mask(const CellGrid& grid) const override;

private:
    MeshSolid(const TriangleMesh& mesh, const TriangleMesh& cones);
    [[nodiscard]] bool contains(const glm::dvec3& point, int closed) const;

    Aabb bounds_;
    TriangleMesh closed_; ///< mesh and cones
    WindingNumber mesh_;
    WindingNumber cones_;
    mutable tbb::collaborative_once_flag measured_;
    mutable double volume_ = 0.0;
};

} // namespace meltpoint
