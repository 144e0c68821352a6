#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

namespace meltpoint {

/// A box of equal cells with the same few points in each: by default one at the center, or, with a jitter seed, one at
/// a random place (stratified sampling: each row along x has y and z of its own, each cell its x). Cells are numbered
/// with x fastest, then y, then z.
struct CellGrid {
    glm::dvec3 origin{0.0};                          ///< m, the corner of the first cell
    glm::dvec3 cell_size{1.0};                       ///< m
    glm::uvec3 count{0};                             ///< cells along each axis
    glm::dmat3 axes{1.0};                            ///< the directions of the axes: a rotation
    std::vector<glm::dvec3> points{glm::dvec3(0.5)}; ///< within a cell, from 0 to 1: at most 8
    std::optional<std::uint64_t> jitter_seed;        ///< with a single point a cell
    bool mirrored = false;                           ///< the jitter's: points on the other side of their cells

    [[nodiscard]] std::size_t size() const { return std::size_t{count.x} * count.y * count.z; } ///< cells
    [[nodiscard]] std::size_t index(const glm::uvec3& cell) const                               ///< a cell's number
    {
        return cell.x + std::size_t{count.x} * (cell.y + std::size_t{count.y} * cell.z);
    }

    /// Rows along x: cells of the same y and z.
    [[nodiscard]] std::size_t rows() const { return std::size_t{count.y} * count.z; }
    [[nodiscard]] glm::uvec3 row_begin(std::size_t row) const { return {0, row % count.y, row / count.y}; } ///< 1st

    /// y and z of point `number` in all cells of a row, in cells from the origin.
    [[nodiscard]] glm::dvec2 row_place(std::size_t row, std::size_t number = 0) const;

    /// x of the same, in cells from the origin.
    [[nodiscard]] double along_row(const glm::uvec3& cell, std::size_t number = 0) const;

    /// m
    [[nodiscard]] glm::dvec3 point(const glm::uvec3& cell, std::size_t number = 0) const;
};

/// What a grid's mask holds: one byte a cell, in which bit i is set for point i.
using CellMask = std::vector<std::uint8_t>;

/// Number of points in a mask.
[[nodiscard]] std::size_t count_points(const CellMask& mask);

} // namespace meltpoint
