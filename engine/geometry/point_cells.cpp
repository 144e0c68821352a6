#include "geometry/point_cells.h"

#include <algorithm>

#include <tbb/parallel_sort.h>

#include "core/aabb.h"
#include "core/parallel_for.h"

namespace meltpoint {

namespace {

constexpr double most_cells = 1048576.0; // along an axis, for keys of three times 21 bits
constexpr std::uint64_t key_y = std::uint64_t{1} << 21;
constexpr std::uint64_t key_z = std::uint64_t{1} << 42;

struct KeyOfPoint {
    std::uint64_t key;
    std::uint32_t point;

    bool operator<(const KeyOfPoint& other) const { return key != other.key ? key < other.key : point < other.point; }
};

/// What is added to the key of a cell for each of the nine rows of three around it.
std::uint64_t row_offset(std::size_t row)
{
    return (row % 3 + 2) * key_y + (row / 3 + 2) * key_z - 3 * (key_y + key_z); // wraps around for -1
}

} // namespace

PointCells::PointCells(std::span<const glm::vec3> points, double edge) : edge_(edge)
{
    Aabb box;
    for (const glm::vec3& point : points) {
        box.extend(point);
    }
    const glm::dvec3 size(box.size());
    edge_ = std::max(edge_, std::max({size.x, size.y, size.z}) / most_cells);
    origin_ = points.empty() ? glm::dvec3(0.0) : glm::dvec3(box.min) - 2.0 * edge_; // so that neighbors have keys too
    std::vector<KeyOfPoint> keys(points.size());
    parallel_for(points.size(), [&](std::size_t i) {
        keys[i] = {key_at(glm::dvec3(points[i])), static_cast<std::uint32_t>(i)};
    });
    tbb::parallel_sort(keys);

    order_.resize(points.size());
    cell_of_place_.resize(points.size());
    for (std::uint32_t place = 0; place < keys.size(); ++place) {
        if (place == 0 || keys[place].key != keys[place - 1].key) {
            cell_keys_.push_back(keys[place].key);
            cell_begin_.push_back(place);
        }
        order_[place] = keys[place].point;
        cell_of_place_[place] = static_cast<std::uint32_t>(cell_keys_.size() - 1);
    }
    cell_begin_.push_back(static_cast<std::uint32_t>(points.size()));
    find_near_ranges();
}

std::uint64_t PointCells::key_at(const glm::dvec3& point) const
{
    const glm::u64vec3 cell(glm::clamp((point - origin_) / edge_, 1.0, most_cells + 4.0));
    return cell.x + cell.y * key_y + cell.z * key_z;
}

/// Keys ascend, and so do those of their neighbors: one sweep over all cells finds each row of neighbors.
void PointCells::find_near_ranges()
{
    near_.resize(cell_keys_.size());
    parallel_for(9, [&](std::size_t row) {
        std::size_t first = 0;
        std::size_t last = 0;
        for (std::size_t cell = 0; cell < cell_keys_.size(); ++cell) {
            const std::uint64_t key = cell_keys_[cell] + row_offset(row);
            while (first < cell_keys_.size() && cell_keys_[first] < key - 1) {
                ++first;
            }
            while (last < cell_keys_.size() && cell_keys_[last] <= key + 1) {
                ++last;
            }
            near_[cell][row] = {cell_begin_[first], cell_begin_[last]};
        }
    });
}

PointCells::Ranges PointCells::ranges_near(const glm::dvec3& point) const
{
    Ranges ranges;
    for (std::size_t row = 0; row < ranges.size(); ++row) {
        const std::uint64_t key = key_at(point) + row_offset(row);
        const auto first = std::lower_bound(cell_keys_.begin(), cell_keys_.end(), key - 1);
        const auto last = std::upper_bound(first, cell_keys_.end(), key + 1);
        ranges[row] = {cell_begin_[static_cast<std::size_t>(first - cell_keys_.begin())],
                       cell_begin_[static_cast<std::size_t>(last - cell_keys_.begin())]};
    }
    return ranges;
}

} // namespace meltpoint
