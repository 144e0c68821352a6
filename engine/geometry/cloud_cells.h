#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "geometry/lists.h"
#include "geometry/local_planes.h"

namespace meltpoint {

/// The piece of surface that each point of a cloud stands for: its Voronoi cell among its neighbors, in its tangent
/// plane (Barill, Dickson, Schmidt, Levin & Jacobson 2018, section 3.2). Together they cover the surface once, whatever
/// the density of the points.
///
/// Neighbors whose normal is more than 120 degrees away lie on the other side of something thin, and do not count.
/// Where no neighbors are, at the rim of a scan or of a hole, a cell ends half a spacing away from its point.
class CloudCells {
public:
    CloudCells() = default;

    /// Normals: unit, or zero for points that have no cell.
    CloudCells(std::span<const glm::vec3> points, std::span<const glm::vec3> normals, const LocalPlanes& planes);

    /// Of a convex polygon around the point, counterclockwise: m along u and v of TangentFrame(normal), from the point.
    /// None where the point has no cell.
    [[nodiscard]] std::span<const glm::vec2> corners(std::size_t point) const { return corners_[point]; }

    /// m^2, one a point.
    [[nodiscard]] const std::vector<double>& areas() const { return areas_; }

private:
    std::vector<double> areas_;
    Lists<glm::vec2> corners_;
};

/// Twice the signed area of the triangle 0, a, b.
[[nodiscard]] inline double cross(const glm::dvec2& a, const glm::dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}

} // namespace meltpoint
