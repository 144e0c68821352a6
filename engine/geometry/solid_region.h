#pragma once

#include "geometry/triangle_mesh.h"
#include "geometry/winding_number.h"

namespace meltpoint {

/// Cones over the holes of a mesh: for each group of connected boundary edges, triangles from the edges to their
/// middle, oriented so that mesh and cones together are closed. Edges count with the direction in which triangles use
/// them, so that any triangle soup can be closed.
[[nodiscard]] TriangleMesh boundary_cones(const TriangleMesh& mesh);

/// Where the winding number of a mesh is at least 1/2, prepared for many queries: w = w_closed - w_cones, where
/// w_closed, of mesh and cones together, is a whole number that changes only across a triangle, and w_cones costs
/// little.
class SolidRegion {
public:
    /// The mesh must be valid (validate()), and is best welded: edges that only seem open cost time.
    explicit SolidRegion(const TriangleMesh& mesh);

    [[nodiscard]] bool contains(const glm::dvec3& point) const { return mesh_.at(point) >= 0.5; }

    /// The same, for a point where w_closed is known.
    [[nodiscard]] bool contains(const glm::dvec3& point, double closed) const;

    /// w_closed at a point that is not on a triangle.
    [[nodiscard]] double closed_at(const glm::dvec3& point) const;

    /// False only if w_closed is the same in all of the box.
    [[nodiscard]] bool may_change_within(const glm::dvec3& low, const glm::dvec3& high) const
    {
        return closed_.may_touch_box(low, high);
    }

private:
    SolidRegion(const TriangleMesh& mesh, const TriangleMesh& cones);

    WindingNumber mesh_;
    WindingNumber closed_;
    WindingNumber cones_;
};

} // namespace meltpoint
