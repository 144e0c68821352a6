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

/// What the divergence theorem says of a surface. With n of unit length, and x from the surface's centroid on:
struct Moments {
    double area = 0.0;
    glm::dvec3 normal{0.0};      ///< integral of n: zero if it is closed
    glm::dmat3 normal_by_x{0.0}; ///< integral of n x^T: volume times identity if it is closed

    /// What lies flat has none, what faces inward less.
    [[nodiscard]] double volume() const { return (normal_by_x[0][0] + normal_by_x[1][1] + normal_by_x[2][2]) / 3.0; }

    [[nodiscard]] bool is_closed() const
    {
        constexpr double tolerance = 0.1; // scans of closed shapes keep within a few percent
        bool closed = glm::length(normal) <= tolerance * area;
        for (int column = 0; column < 3; ++column) {
            for (int row = 0; row < 3; ++row) {
                const double expected = row == column ? volume() : 0.0;
                closed = closed && std::abs(normal_by_x[column][row] - expected) <= tolerance * std::abs(volume());
            }
        }
        return closed;
    }
};

Moments moments_of(const std::vector<WindingNumber::Triangle>& triangles)
{
    Moments moments;
    glm::dvec3 center(0.0);
    for (const WindingNumber::Triangle& t : triangles) {
        const glm::dvec3 normal = 0.5 * glm::cross(t[1] - t[0], t[2] - t[0]); // as long as the area
        const glm::dvec3 x = (t[0] + t[1] + t[2]) / 3.0 - triangles[0][0]; // from a corner, for the sake of precision
        moments.area += glm::length(normal);
        center += glm::length(normal) * x;
        moments.normal += normal;
        moments.normal_by_x += glm::outerProduct(normal, x);
    }
    if (moments.area > 0.0) {
        moments.normal_by_x -= glm::outerProduct(moments.normal, center / moments.area);
    }
    return moments;
}

} // namespace

CloudSolid::CloudSolid(const CloudSurface& surface)
{
    std::vector<WindingNumber::Triangle> triangles = triangles_of(surface);
    const Moments moments = moments_of(triangles);
    signed_volume_ = moments.volume();
    inside_out_ = signed_volume_ < 0.0 && moments.is_closed();
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
