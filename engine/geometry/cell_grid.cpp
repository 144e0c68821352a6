#include "geometry/cell_grid.h"

#include <bit>

#include "core/random.h"

namespace meltpoint {

namespace {

constexpr std::uint64_t row_streams = std::uint64_t{1} << 48; // apart from the cells'

} // namespace

glm::dvec2 CellGrid::row_place(std::size_t row, std::size_t number) const
{
    const glm::uvec3 cell = row_begin(row);
    if (jitter_seed) {
        Random random(*jitter_seed, row_streams + row);
        const double y = random.uniform();
        const double z = random.uniform();
        return {cell.y + (mirrored ? 1.0 - y : y), cell.z + (mirrored ? 1.0 - z : z)};
    }
    return {cell.y + points[number].y, cell.z + points[number].z};
}

double CellGrid::along_row(const glm::uvec3& cell, std::size_t number) const
{
    if (jitter_seed) {
        const double x = Random(*jitter_seed, index(cell)).uniform();
        return cell.x + (mirrored ? 1.0 - x : x);
    }
    return cell.x + points[number].x;
}

glm::dvec3 CellGrid::point(const glm::uvec3& cell, std::size_t number) const
{
    const glm::dvec2 row = row_place(cell.y + std::size_t{count.y} * cell.z, number);
    return origin + axes * (cell_size * glm::dvec3(along_row(cell, number), row.x, row.y));
}

std::size_t count_points(const CellMask& mask)
{
    std::size_t count = 0;
    for (const std::uint8_t cell : mask) {
        count += static_cast<std::size_t>(std::popcount(cell));
    }
    return count;
}

} // namespace meltpoint
