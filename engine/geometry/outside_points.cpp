#include "geometry/outside_points.h"

#include <algorithm>
#include <cmath>

#include "core/parallel_for.h"

namespace meltpoint {

namespace {

/// Sets every cell that has one set within `reach` cells of it along the axis.
void dilate(CellMask& mask, const CellGrid& grid, int axis, std::uint32_t reach)
{
    const std::size_t stride = axis == 0 ? 1 : axis == 1 ? grid.count.x : std::size_t{grid.count.x} * grid.count.y;
    const std::uint32_t length = grid.count[axis];
    glm::uvec3 lines = grid.count;
    lines[axis] = 1;
    parallel_for(std::size_t{lines.x} * lines.y * lines.z, [&](std::size_t line) {
        const glm::uvec3 start(line % lines.x, line / lines.x % lines.y, line / (std::size_t{lines.x} * lines.y));
        std::uint8_t* const first = mask.data() + grid.index(start);
        std::vector<std::uint8_t> grown(length, 0);
        std::uint32_t filled = 0; // up to here
        for (std::uint32_t i = 0; i < length; ++i) {
            if (first[i * stride] != 0) {
                const std::uint32_t end = std::min(i + reach + 1, length);
                for (std::uint32_t k = std::max(filled, i - std::min(i, reach)); k < end; ++k) {
                    grown[k] = 1;
                }
                filled = end;
            }
        }
        for (std::uint32_t i = 0; i < length; ++i) {
            first[i * stride] = grown[i];
        }
    });
}

/// Cells that fit the solid's box, and those around it within the reach.
CellGrid fitted_grid(const Solid& solid, double edge, double reach)
{
    const Aabb box = solid.bounds();
    const glm::dvec3 size = glm::max(glm::dvec3(box.size()), glm::dvec3(1e-3 * edge));
    const glm::dvec3 across = glm::ceil(size / edge);
    CellGrid grid;
    grid.cell_size = size / across;
    const glm::dvec3 margin = glm::ceil(reach / grid.cell_size) + 1.0;
    grid.origin = glm::dvec3(box.center()) - 0.5 * size - margin * grid.cell_size;
    grid.count = glm::uvec3(across + 2.0 * margin);
    grid.points.clear();
    for (unsigned i = 0; i < 8; ++i) {
        grid.points.push_back(0.25 + 0.5 * glm::dvec3(i & 1, i >> 1 & 1, i >> 2 & 1));
    }
    return grid;
}

/// The mask, and every cell with one set within the reach.
CellMask reached(CellMask mask, const CellGrid& grid, double reach)
{
    for (int axis = 0; axis < 3; ++axis) {
        dilate(mask, grid, axis, static_cast<std::uint32_t>(std::ceil(reach / grid.cell_size[axis])) + 1);
    }
    return mask;
}

template <class Visit>
void visit_cells(const CellGrid& grid, const Visit& visit)
{
    glm::uvec3 cell(0);
    for (cell.z = 0; cell.z < grid.count.z; ++cell.z) {
        for (cell.y = 0; cell.y < grid.count.y; ++cell.y) {
            for (cell.x = 0; cell.x < grid.count.x; ++cell.x) {
                visit(cell);
            }
        }
    }
}

} // namespace

CellsNear cells_near(const Solid& solid, double edge, double reach)
{
    CellsNear near{fitted_grid(solid, edge, reach), {}};
    const CellMask mask = reached(solid.mask(near.grid), near.grid, reach);
    visit_cells(near.grid, [&](const glm::uvec3& cell) {
        if (mask[near.grid.index(cell)] != 0) {
            near.cells.push_back(cell);
        }
    });
    return near;
}

OutsidePoints points_outside(const Solid& solid, double edge, double reach)
{
    const CellGrid grid = fitted_grid(solid, edge, reach);
    const CellMask inside = solid.mask(grid);
    const CellMask near = reached(inside, grid, reach);
    OutsidePoints points;
    const double volume = grid.cell_size.x * grid.cell_size.y * grid.cell_size.z;
    visit_cells(grid, [&](const glm::uvec3& cell) {
        const std::size_t i = grid.index(cell);
        glm::dvec3 sum(0.0);
        double eighths = 0.0;
        for (std::size_t k = 0; k < grid.points.size(); ++k) {
            if ((inside[i] >> k & 1) == 0) {
                sum += grid.point(cell, k);
                eighths += 1.0;
            }
        }
        if (near[i] != 0 && eighths > 0.0) {
            points.positions.emplace_back(sum / eighths);
            points.volumes.push_back(volume * eighths / 8.0);
        }
    });
    return points;
}

} // namespace meltpoint
