#include "geometry/cloud_solid.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/parallel_for.h"
#include "geometry/measure_volume.h"
#include "geometry/tangent_frame.h"
#include "geometry/winding_thresholds.h"

namespace meltpoint {

namespace {

// A cloud is not known more exactly, and its winding numbers cost more than a mesh's.
constexpr VolumeAccuracy accuracy{.error = 1e-3, .first_cells = 40e3, .most_cells = 0x1p20};

// Where cells overlap, there is a little inside between them even if they lie flat or face inward. It is told from a
// body by the signed volume, which of a closed surface is all of the measured one, of half a sphere three quarters.
constexpr double least_share = 0.25;

std::vector<WindingNumber::Triangle> triangles_of(const CloudSurface& surface)
{
    std::vector<WindingNumber::Triangle> triangles;
    triangles.reserve(surface.cloud.size());
    for (std::size_t i = 0; i < surface.cloud.size(); ++i) {
        const double area = surface.cells.areas()[i];
        if (!(area > 0.0)) {
            continue;
        }
        const TangentFrame frame(glm::normalize(glm::dvec3(surface.cloud.normals[i])));
        const double radius = std::sqrt(area * 4.0 / std::sqrt(27.0)); // of the circle through the corners
        const glm::dvec3 center(surface.cloud.positions[i]);
        const glm::dvec3 half = 0.5 * std::sqrt(3.0) * radius * frame.v;
        triangles.push_back({center + radius * frame.u, center - 0.5 * radius * frame.u + half,
                             center - 0.5 * radius * frame.u - half});
    }
    return triangles;
}

/// By the divergence theorem about their centroid: what lies flat has none, what faces inward less.
double signed_volume(const std::vector<WindingNumber::Triangle>& triangles)
{
    double area = 0.0;
    glm::dvec3 center(0.0);
    double volume = 0.0;
    glm::dvec3 normals(0.0);
    for (const WindingNumber::Triangle& t : triangles) {
        const glm::dvec3 normal = 0.5 * glm::cross(t[1] - t[0], t[2] - t[0]); // as long as the area
        const glm::dvec3 middle = (t[0] + t[1] + t[2]) / 3.0;
        area += glm::length(normal);
        center += glm::length(normal) * middle;
        volume += glm::dot(normal, middle - triangles[0][0]) / 3.0; // about a corner, for the sake of precision
        normals += normal;
    }
    return area > 0.0 ? volume - glm::dot(normals, center / area - triangles[0][0]) / 3.0 : 0.0;
}

} // namespace

CloudSolid::CloudSolid(const CloudSurface& surface) : CloudSolid(triangles_of(surface)) {}

CloudSolid::CloudSolid(std::vector<WindingNumber::Triangle> triangles) : signed_volume_(signed_volume(triangles))
{
    for (const WindingNumber::Triangle& triangle : triangles) {
        for (const glm::dvec3& corner : triangle) {
            bounds_.extend(glm::vec3(corner));
        }
    }
    winding_ = WindingNumber(std::move(triangles));
}

double CloudSolid::volume() const
{
    tbb::collaborative_call_once(measured_, [this] {
        const double measured = signed_volume_ > 0.0 ? measure_volume(*this, accuracy) : 0.0;
        volume_ = signed_volume_ > least_share * measured ? measured : 0.0;
    });
    return volume_;
}

bool CloudSolid::contains(const glm::dvec3& point) const
{
    return winding_.is_inside(point);
}

CellMask CloudSolid::mask(const CellGrid& grid) const
{
    CellMask mask(grid.size(), 0);
    const std::vector<std::int8_t> thresholds = winding_thresholds(winding_, grid);
    parallel_for(grid.rows(), [&](std::size_t row) {
        for (glm::uvec3 cell = grid.row_begin(row); cell.x < grid.count.x; ++cell.x) {
            const std::int8_t threshold = thresholds[grid.index(cell)];
            for (std::size_t number = 0; number < grid.points.size(); ++number) {
                // 1 - w >= 1/2 means outside: everywhere in the cell, or nowhere.
                const bool inside = threshold != no_threshold ? threshold > 1 : contains(grid.point(cell, number));
                mask[grid.index(cell)] |= static_cast<std::uint8_t>(unsigned{inside} << number);
            }
        }
    });
    return mask;
}

} // namespace meltpoint
