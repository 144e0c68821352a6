#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace meltpoint {

/// Finds the points that are nearest to one of them, or to a place, whatever their density: a k-d tree. Safe to query
/// from several threads.
class NearestPoints {
public:
    /// At most 2^32 - 1 points, finite; they must outlive this.
    explicit NearestPoints(std::span<const glm::vec3> points);
    NearestPoints(const NearestPoints&) = delete;
    NearestPoints& operator=(const NearestPoints&) = delete;
    ~NearestPoints();

    /// The numbers of the `count` points nearest to one, without itself, nearest first; fewer where there are no more.
    [[nodiscard]] std::vector<std::uint32_t> of(std::uint32_t point, std::size_t count) const;

    /// The number of the point nearest to a place, which need not be one of them. There must be points.
    [[nodiscard]] std::uint32_t nearest_to(const glm::vec3& place) const;

private:
    class Tree;
    std::unique_ptr<const Tree> tree_;
};

} // namespace meltpoint
