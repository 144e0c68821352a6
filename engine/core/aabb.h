#pragma once

#include <limits>

#include <glm/glm.hpp>

namespace meltpoint {

/// Axis-aligned bounding box in meters. Starts empty (min > max).
struct Aabb {
    glm::vec3 min{std::numeric_limits<float>::infinity()};
    glm::vec3 max{-std::numeric_limits<float>::infinity()};
    /// Grows to contain a point (m).
    void extend(const glm::vec3& point)
    {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }

    [[nodiscard]] bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; } ///< no point in it
    [[nodiscard]] glm::vec3 size() const { return empty() ? glm::vec3(0.0f) : max - min; }       ///< m
    [[nodiscard]] glm::vec3 center() const { return 0.5f * (min + max); } ///< m; not a number if empty
    [[nodiscard]] bool contains(const glm::vec3& point) const             ///< faces belong to it
    {
        return glm::all(glm::greaterThanEqual(point, min)) && glm::all(glm::lessThanEqual(point, max));
    }
};

} // namespace meltpoint
