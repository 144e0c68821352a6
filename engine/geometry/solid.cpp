#include "geometry/solid.h"

#include <numbers>

#include "core/parallel_for.h"

namespace meltpoint {

CellMask Solid::mask(const CellGrid& grid) const
{
    CellMask mask(grid.size());
    parallel_for(grid.rows(), [&](std::size_t row) {
        glm::uvec3 cell = grid.row_begin(row);
        for (; cell.x < grid.count.x; ++cell.x) {
            unsigned inside = 0;
            for (std::size_t i = 0; i < grid.points.size(); ++i) {
                inside |= contains(grid.point(cell, i)) ? 1u << i : 0u;
            }
            mask[grid.index(cell)] = static_cast<std::uint8_t>(inside);
        }
    });
    return mask;
}

double BoxSolid::volume() const
{
    const glm::dvec3 size(glm::dvec3(box_.max) - glm::dvec3(box_.min));
    return box_.empty() ? 0.0 : size.x * size.y * size.z;
}

bool BoxSolid::contains(const glm::dvec3& point) const
{
    return glm::all(glm::greaterThanEqual(point, glm::dvec3(box_.min))) &&
           glm::all(glm::lessThanEqual(point, glm::dvec3(box_.max)));
}

Aabb BallSolid::bounds() const
{
    return {glm::vec3(center_ - radius_), glm::vec3(center_ + radius_)};
}

double BallSolid::volume() const
{
    return 4.0 / 3.0 * std::numbers::pi * radius_ * radius_ * radius_;
}

bool BallSolid::contains(const glm::dvec3& point) const
{
    const glm::dvec3 from_center = point - center_;
    return glm::dot(from_center, from_center) <= radius_ * radius_;
}

} // namespace meltpoint
