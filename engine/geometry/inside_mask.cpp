// Between cells that no triangle touches, the winding number of the closed mesh is a constant: a row of them needs one
// query. So the costly queries grow with the surface, not with the volume.

#include "geometry/inside_mask.h"

#include "core/parallel_for.h"
#include "core/random.h"

namespace meltpoint {

namespace {

constexpr std::uint32_t task_edge = 16; // cells along the edge of a block that one task marks

/// Marks the cells that a triangle may touch, halving blocks until they are free of triangles or single cells.
class SurfaceMarker {
public:
    SurfaceMarker(const SolidRegion& region, const CellGrid& grid, std::vector<std::uint8_t>& marks)
        : region_(region), grid_(grid), marks_(marks)
    {
    }

    void mark(const glm::uvec3& begin, const glm::uvec3& end) const
    {
        const glm::dvec3 low = grid_.origin + grid_.cell_size * glm::dvec3(begin);
        const glm::dvec3 high = grid_.origin + grid_.cell_size * glm::dvec3(end);
        if (!region_.may_change_within(low, high)) {
            return;
        }
        const glm::uvec3 edge = end - begin;
        if (edge == glm::uvec3(1)) {
            marks_[grid_.index(begin)] = 1;
            return;
        }
        const int axis = edge.x >= edge.y && edge.x >= edge.z ? 0 : edge.y >= edge.z ? 1 : 2;
        glm::uvec3 low_end = end;
        glm::uvec3 high_begin = begin;
        low_end[axis] = high_begin[axis] = begin[axis] + edge[axis] / 2;
        mark(begin, low_end);
        mark(high_begin, end);
    }

private:
    const SolidRegion& region_;
    const CellGrid& grid_;
    std::vector<std::uint8_t>& marks_;
};

void mark_surface(const SolidRegion& region, const CellGrid& grid, std::vector<std::uint8_t>& marks)
{
    const SurfaceMarker marker(region, grid, marks);
    const glm::uvec3 tasks = (grid.count + (task_edge - 1)) / task_edge;
    parallel_for(std::size_t{tasks.x} * tasks.y * tasks.z, [&](std::size_t task) {
        const glm::uvec3 block(task % tasks.x, task / tasks.x % tasks.y, task / (std::size_t{tasks.x} * tasks.y));
        marker.mark(task_edge * block, glm::min(task_edge * (block + 1u), grid.count));
    });
}

} // namespace

glm::dvec3 CellGrid::point(const glm::uvec3& cell) const
{
    glm::dvec3 within(0.5);
    if (jitter_seed) {
        Random random(*jitter_seed, index(cell));
        within.x = random.uniform();
        within.y = random.uniform();
        within.z = random.uniform();
    }
    return origin + cell_size * (glm::dvec3(cell) + within);
}

std::vector<std::uint8_t> inside_mask(const SolidRegion& region, const CellGrid& grid)
{
    std::vector<std::uint8_t> mask(grid.size(), 0);
    mark_surface(region, grid, mask);
    parallel_for(std::size_t{grid.count.y} * grid.count.z, [&](std::size_t row) {
        std::optional<double> closed; // of the run of free cells that the row is in
        glm::uvec3 cell(0, row % grid.count.y, row / grid.count.y);
        for (cell.x = 0; cell.x < grid.count.x; ++cell.x) {
            std::uint8_t& inside = mask[grid.index(cell)];
            const glm::dvec3 point = grid.point(cell);
            if (inside != 0) {
                inside = region.contains(point) ? 1 : 0;
                closed.reset();
            } else {
                closed = closed ? closed : region.closed_at(point);
                inside = region.contains(point, *closed) ? 1 : 0;
            }
        }
    });
    return mask;
}

} // namespace meltpoint
