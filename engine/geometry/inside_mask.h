#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "geometry/solid_region.h"

namespace meltpoint {

/// A box of equal cells with one point in each: at its center, or, with a jitter seed, at a random place of its own
/// (stratified sampling). Cells are numbered with x fastest, then y, then z.
struct CellGrid {
    glm::dvec3 origin{0.0};    ///< m, the lowest corner
    glm::dvec3 cell_size{1.0}; ///< m
    glm::uvec3 count{0};       ///< cells along each axis
    std::optional<std::uint64_t> jitter_seed;

    [[nodiscard]] std::size_t size() const { return std::size_t{count.x} * count.y * count.z; }
    [[nodiscard]] std::size_t index(const glm::uvec3& cell) const
    {
        return cell.x + std::size_t{count.x} * (cell.y + std::size_t{count.y} * cell.z);
    }
    [[nodiscard]] glm::dvec3 point(const glm::uvec3& cell) const;
};

/// One byte a cell: 1 where the region contains the cell's point, else 0.
[[nodiscard]] std::vector<std::uint8_t> inside_mask(const SolidRegion& region, const CellGrid& grid);

} // namespace meltpoint
