#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

namespace meltpoint {

/// Points sorted into cubic cells, to visit all that are nearer to one than the cells' edge. Points have a place in the
/// order of the cells: neighbors in space are neighbors in memory there. Holds only the cells that have points, so that
/// surfaces cost no more than volumes.
class PointCells {
public:
    /// At most 2^32 - 1 points, finite; the edge (m) above zero.
    PointCells(std::span<const glm::vec3> points, double edge);

    /// The number of each point, in the order of the cells.
    [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }

    /// Calls visit(place) for the places of all points that may be nearer than the edge to the point of the given
    /// place, that one among them, always in the same order.
    template <class Visit>
    void visit_near(std::size_t place, const Visit& visit) const
    {
        for (const auto& [begin, end] : near_[cell_of_place_[place]]) {
            for (std::uint32_t other = begin; other < end; ++other) {
                visit(other);
            }
        }
    }

    /// The same for any point in space: costs a search.
    template <class Visit>
    void visit_near(const glm::dvec3& point, const Visit& visit) const
    {
        for (const auto& [begin, end] : ranges_near(point)) {
            for (std::uint32_t other = begin; other < end; ++other) {
                visit(other);
            }
        }
    }

private:
    using Range = std::pair<std::uint32_t, std::uint32_t>; ///< of places
    using Ranges = std::array<Range, 9>;                   ///< three cells along x each

    [[nodiscard]] std::uint64_t key_at(const glm::dvec3& point) const;
    [[nodiscard]] Ranges ranges_near(const glm::dvec3& point) const;
    void find_near_ranges();

    glm::dvec3 origin_{0.0};
    double edge_;
    std::vector<std::uint32_t> order_;
    std::vector<std::uint64_t> cell_keys_;  ///< ascending
    std::vector<std::uint32_t> cell_begin_; ///< the first place in each cell, and the end
    std::vector<std::uint32_t> cell_of_place_;
    std::vector<Ranges> near_; ///< of each cell
};

} // namespace meltpoint
