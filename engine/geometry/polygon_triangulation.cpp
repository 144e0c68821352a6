#include "geometry/polygon_triangulation.h"

#include <algorithm>
#include <cmath>

namespace meltpoint {

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}

/// The polygon in the coordinate plane that it faces most, counterclockwise (Newell's normal; Sutherland et al. 1974).
std::vector<glm::dvec2> flatten(std::span<const std::uint32_t> corners, const std::vector<glm::vec3>& positions)
{
    const glm::dvec3 origin(positions[corners[0]]);
    glm::dvec3 normal(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::dvec3(positions[corners[i]]) - origin;
        const glm::dvec3 b = glm::dvec3(positions[corners[(i + 1) % corners.size()]]) - origin;
        normal += glm::cross(a, b);
    }
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::vector<glm::dvec2> points;
    points.reserve(corners.size());
    for (const std::uint32_t corner : corners) {
        const glm::dvec3 p = glm::dvec3(positions[corner]) - origin;
        const glm::dvec2 flat(p[(axis + 1) % 3], p[(axis + 2) % 3]);
        points.push_back(normal[axis] < 0.0 ? glm::dvec2(flat.y, flat.x) : flat);
    }
    return points;
}

/// The corners that are left, as a ring.
class Ring {
public:
    explicit Ring(std::vector<glm::dvec2> points) : points_(std::move(points))
    {
        const std::size_t count = points_.size();
        for (std::size_t i = 0; i < count; ++i) {
            next_.push_back((i + 1) % count);
            previous_.push_back((i + count - 1) % count);
        }
        for (std::size_t i = 0; i < count; ++i) {
            if (!turns_left(i)) {
                reflex_.push_back(i);
            }
        }
    }

    [[nodiscard]] std::size_t next(std::size_t i) const { return next_[i]; }
    [[nodiscard]] std::size_t previous(std::size_t i) const { return previous_[i]; }

    void remove(std::size_t i)
    {
        next_[previous_[i]] = next_[i];
        previous_[next_[i]] = previous_[i];
        std::erase(reflex_, i);
    }

    /// Whether the triangle at a corner can be cut off: it turns left, and no other corner lies in it.
    [[nodiscard]] bool is_ear(std::size_t i) const
    {
        const glm::dvec2& a = points_[previous_[i]];
        const glm::dvec2& b = points_[i];
        const glm::dvec2& c = points_[next_[i]];
        if (!turns_left(i)) {
            return false;
        }
        // If any corner lies in the triangle, then one that turned right does (Eberly 1998).
        return std::ranges::none_of(reflex_, [&](std::size_t other) {
            const glm::dvec2& p = points_[other];
            const bool is_corner = p == a || p == b || p == c;
            return !is_corner && cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0;
        });
    }

private:
    [[nodiscard]] bool turns_left(std::size_t i) const
    {
        const glm::dvec2& b = points_[i];
        return cross(b - points_[previous_[i]], points_[next_[i]] - b) > 0.0;
    }

    std::vector<glm::dvec2> points_;
    std::vector<std::size_t> reflex_; ///< corners that do not turn left in the whole polygon
    std::vector<std::size_t> next_;
    std::vector<std::size_t> previous_;
};

} // namespace

void triangulate_polygon(std::span<const std::uint32_t> corners, const std::vector<glm::vec3>& positions,
                         std::vector<glm::uvec3>& triangles)
{
    if (corners.size() <= 3) {
        if (corners.size() == 3) {
            triangles.emplace_back(corners[0], corners[1], corners[2]);
        }
        return;
    }
    Ring ring(flatten(corners, positions));
    std::vector<bool> ear(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        ear[i] = ring.is_ear(i);
    }
    std::size_t current = 0;
    for (std::size_t left = corners.size(); left >= 3; --left) {
        // Only a polygon with crossing or collinear edges runs out of ears: then any corner goes.
        for (std::size_t tried = 0; tried < left && !ear[current]; ++tried) {
            current = ring.next(current);
        }
        const std::size_t before = ring.previous(current);
        const std::size_t after = ring.next(current);
        triangles.emplace_back(corners[before], corners[current], corners[after]);
        ring.remove(current);
        ear[before] = ring.is_ear(before);
        ear[after] = ring.is_ear(after);
        current = ring.next(after); // not the same corner again: a fan of slivers
    }
}

} // namespace meltpoint
