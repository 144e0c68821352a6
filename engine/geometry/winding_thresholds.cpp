#include "geometry/winding_thresholds.h"

#include <algorithm>
#include <cmath>

#include "core/parallel_for.h"

namespace meltpoint {

namespace {

constexpr std::uint32_t task_edge = 32;     // cells along the edge of a block that one task looks at
constexpr std::uint32_t smallest_block = 4; // cells along its longest edge: the cells of less are as soon queried
// How far w may lie outside of what it is at the corners of a block: the triangles are as far away as the block is
// wide, and the hierarchical sum has an error too.
constexpr double margin = 0.1;
constexpr double highest_threshold = 100.0;

/// Halves blocks until their threshold is known or they are small.
class ThresholdFinder {
public:
    ThresholdFinder(const WindingNumber& winding, const CellGrid& grid, std::vector<std::int8_t>& thresholds)
        : winding_(winding), grid_(grid), thresholds_(thresholds)
    {
        for (int axis = 0; axis < 3; ++axis) {
            reach_[axis] = 0.5 * grid.cell_size[axis] * glm::abs(grid.axes[axis]);
        }
    }

    void find(const glm::uvec3& begin, const glm::uvec3& end) const
    {
        const glm::uvec3 edge = end - begin;
        const bool small = std::max({edge.x, edge.y, edge.z}) < smallest_block;
        const std::int8_t threshold = small ? no_threshold : of_block(glm::dvec3(begin), glm::dvec3(end));
        if (threshold != no_threshold || small) {
            fill(begin, end, threshold);
            return;
        }
        const int axis = edge.x >= edge.y && edge.x >= edge.z ? 0 : edge.y >= edge.z ? 1 : 2;
        glm::uvec3 low_end = end;
        glm::uvec3 high_begin = begin;
        low_end[axis] = high_begin[axis] = begin[axis] + edge[axis] / 2;
        find(begin, low_end);
        find(high_begin, end);
    }

private:
    [[nodiscard]] std::int8_t of_block(const glm::dvec3& begin, const glm::dvec3& end) const
    {
        const glm::dvec3 middle = place(0.5 * (begin + end));
        const glm::dvec3 half = reach_ * (end - begin); // of the box around the block
        const double width = 2.0 * std::max({half.x, half.y, half.z});
        if (winding_.may_touch_box(middle - half - width, middle + half + width)) {
            return no_threshold;
        }
        double lowest = winding_.at(middle);
        double highest = lowest;
        for (unsigned corner = 0; corner < 8; ++corner) {
            const glm::dvec3 high(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
            const double w = winding_.at(place(glm::mix(begin, end, high)));
            lowest = std::min(lowest, w);
            highest = std::max(highest, w);
        }
        const double low = std::ceil(0.5 + lowest - margin);
        const double high = std::ceil(0.5 + highest + margin);
        return low == high && std::abs(low) < highest_threshold ? static_cast<std::int8_t>(low) : no_threshold;
    }

    void fill(const glm::uvec3& begin, const glm::uvec3& end, std::int8_t threshold) const
    {
        for (std::uint32_t z = begin.z; z < end.z; ++z) {
            for (std::uint32_t y = begin.y; y < end.y; ++y) {
                std::fill_n(thresholds_.data() + grid_.index({begin.x, y, z}), end.x - begin.x, threshold);
            }
        }
    }

    [[nodiscard]] glm::dvec3 place(const glm::dvec3& cells) const
    {
        return grid_.origin + grid_.axes * (grid_.cell_size * cells);
    }

    const WindingNumber& winding_;
    const CellGrid& grid_;
    std::vector<std::int8_t>& thresholds_;
    glm::dmat3 reach_{0.0};
};

} // namespace

std::vector<std::int8_t> winding_thresholds(const WindingNumber& winding, const CellGrid& grid)
{
    std::vector<std::int8_t> thresholds(grid.size());
    const ThresholdFinder finder(winding, grid, thresholds);
    const glm::uvec3 tasks = (grid.count + (task_edge - 1)) / task_edge;
    parallel_for(std::size_t{tasks.x} * tasks.y * tasks.z, [&](std::size_t task) {
        const glm::uvec3 block(task % tasks.x, task / tasks.x % tasks.y, task / (std::size_t{tasks.x} * tasks.y));
        finder.find(task_edge * block, glm::min(task_edge * (block + 1u), grid.count));
    });
    return thresholds;
}

} // namespace meltpoint
