#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/cell_grid.h"
#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// Where the rows of a grid pass through the triangles of a mesh. If the mesh is closed, the winding number along a row
/// is a whole number that begins with 0 and changes only there, so that a row takes two additions where a query of each
/// of its points would take a walk through a tree.
class RowCrossings {
public:
    struct Crossing {
        double x;   ///< in cells from the grid's origin
        int change; ///< of the winding number: 1 where the row goes in, -1 where it comes out
    };

    /// For point `number` of the grid's cells.
    RowCrossings(const TriangleMesh& mesh, const CellGrid& grid, std::size_t number);

    /// In the order of x.
    [[nodiscard]] std::span<const Crossing> of_row(std::size_t row) const
    {
        return std::span(crossings_).subspan(begin_[row], begin_[row + 1] - begin_[row]);
    }

    /// False where the row passes so close to an edge that rounding hides on which side.
    [[nodiscard]] bool is_certain(std::size_t row) const { return uncertain_[row] == 0; }

private:
    std::vector<Crossing> crossings_;
    std::vector<std::size_t> begin_; ///< of each row, and the end
    std::vector<std::uint8_t> uncertain_;
};

} // namespace meltpoint
