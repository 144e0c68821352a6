#include "geometry/row_crossings.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include <tbb/parallel_sort.h>

#include "core/parallel_for.h"
#include "core/random.h"

namespace meltpoint {

namespace {

constexpr std::size_t triangles_a_task = 4096;
constexpr double nudge = 1e-7; // cells

struct RowCrossing {
    std::uint64_t row;
    RowCrossings::Crossing crossing;

    bool operator<(const RowCrossing& other) const
    {
        if (row != other.row) {
            return row < other.row;
        }
        return crossing.x != other.crossing.x ? crossing.x < other.crossing.x : crossing.change < other.crossing.change;
    }
};

/// The place of every row's points. Rows are moved aside a little, each in a direction of its own, so that rows of a
/// lattice do not hit the edges of a mesh of round numbers: no point cares for a ten millionth of a cell.
std::vector<glm::dvec2> row_places(const CellGrid& grid, std::size_t number)
{
    std::vector<glm::dvec2> places(grid.rows());
    parallel_for(places.size(), [&](std::size_t row) {
        Random random(0x726f7773, row);
        const double y = nudge * (random.uniform() - 0.5);
        const double z = nudge * (random.uniform() - 0.5);
        places[row] = grid.row_place(row, number) + glm::dvec2(y, z);
    });
    return places;
}

/// On which side of the line from a to b a row passes, seen along x: twice the area of the triangle with the row. It
/// is calculated from the same end for both triangles of an edge, so that they agree, and zero where rounding could
/// have changed its sign.
double side(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec2& row)
{
    if (b.y != a.y ? b.y < a.y : b.z < a.z) {
        return -side(b, a, row);
    }
    const double first = (b.y - a.y) * (row.y - a.z);
    const double second = (b.z - a.z) * (row.x - a.y);
    const double scale = std::max({std::abs(a.y), std::abs(a.z), std::abs(b.y), std::abs(b.z)});
    const double error = 8.0 * std::numeric_limits<double>::epsilon() *
                         (std::abs(first) + std::abs(second) + scale * (std::abs(b.y - a.y) + std::abs(b.z - a.z)));
    const double value = first - second;
    return std::abs(value) > error ? value : 0.0;
}

/// The first and last of the rows that can pass between two coordinates.
glm::ivec2 row_range(double low, double high, std::uint32_t count)
{
    const double first = std::clamp(std::floor(low) - 1.0, 0.0, static_cast<double>(count));
    const double last = std::clamp(std::floor(high) + 1.0, -1.0, static_cast<double>(count) - 1.0);
    return {static_cast<int>(first), static_cast<int>(last)};
}

} // namespace

RowCrossings::RowCrossings(const TriangleMesh& mesh, const CellGrid& grid, std::size_t number)
    : begin_(grid.rows() + 1), uncertain_(grid.rows(), 0)
{
    const std::vector<glm::dvec2> places = row_places(grid, number);
    std::vector<glm::dvec3> corners(mesh.positions.size()); // in cells from the origin
    const glm::dmat3 to_cells = glm::transpose(grid.axes);
    parallel_for(corners.size(), [&](std::size_t i) {
        corners[i] = to_cells * (glm::dvec3(mesh.positions[i]) - grid.origin) / grid.cell_size;
    });

    const auto cross = [&](const glm::uvec3& triangle, std::size_t row, std::vector<RowCrossing>& found) {
        const std::array<glm::dvec3, 3> t = {corners[triangle.x], corners[triangle.y], corners[triangle.z]};
        const glm::dvec3 sides(side(t[1], t[2], places[row]), side(t[2], t[0], places[row]),
                               side(t[0], t[1], places[row]));
        if ((glm::any(glm::lessThan(sides, glm::dvec3(0.0))) && glm::any(glm::greaterThan(sides, glm::dvec3(0.0))))) {
            return; // passes by
        }
        if (glm::any(glm::equal(sides, glm::dvec3(0.0)))) {
            std::atomic_ref(uncertain_[row]).store(1, std::memory_order_relaxed);
            return;
        }
        const double sum = sides.x + sides.y + sides.z; // positive where the normal points along x
        const double x = (sides.x * t[0].x + sides.y * t[1].x + sides.z * t[2].x) / sum;
        found.push_back({row, {x, sum > 0.0 ? -1 : 1}});
    };
    const std::size_t tasks = (mesh.triangles.size() + triangles_a_task - 1) / triangles_a_task;
    std::vector<std::vector<RowCrossing>> of_task(tasks);
    parallel_for(tasks, [&](std::size_t task) {
        const std::size_t end = std::min((task + 1) * triangles_a_task, mesh.triangles.size());
        for (std::size_t i = task * triangles_a_task; i < end; ++i) {
            const glm::uvec3& t = mesh.triangles[i];
            const glm::dvec3 low = glm::min(corners[t.x], glm::min(corners[t.y], corners[t.z]));
            const glm::dvec3 high = glm::max(corners[t.x], glm::max(corners[t.y], corners[t.z]));
            const glm::ivec2 y = row_range(low.y, high.y, grid.count.y);
            const glm::ivec2 z = row_range(low.z, high.z, grid.count.z);
            for (int k = z.x; k <= z.y; ++k) {
                for (int j = y.x; j <= y.y; ++j) {
                    const std::size_t row = static_cast<std::size_t>(j) + grid.count.y * static_cast<std::size_t>(k);
                    const glm::dvec2& place = places[row];
                    if (place.x >= low.y && place.x <= high.y && place.y >= low.z && place.y <= high.z) {
                        cross(t, row, of_task[task]);
                    }
                }
            }
        }
    });

    std::vector<RowCrossing> all;
    for (const std::vector<RowCrossing>& some : of_task) {
        all.insert(all.end(), some.begin(), some.end());
    }
    tbb::parallel_sort(all);
    crossings_.resize(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        crossings_[i] = all[i].crossing;
        ++begin_[all[i].row + 1];
    }
    for (std::size_t row = 0; row + 1 < begin_.size(); ++row) {
        begin_[row + 1] += begin_[row];
    }
}

} // namespace meltpoint
