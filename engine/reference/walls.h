#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>

#include "reference/state.h"

namespace meltpoint::reference {

/// Calls body(signed distance in meters, positive inside; inward unit normal) for every wall of the domain.
template <class Body>
void for_each_wall(const shared::SphParams& params, const glm::dvec3& position, const Body& body)
{
    for (int wall = 0; wall < 6; ++wall) {
        if ((params.wall_mask >> wall & 1u) == 0u) {
            continue;
        }
        const int axis = wall / 2;
        const bool at_max = wall % 2 == 1;
        const double plane = static_cast<double>(at_max ? params.domain_max[axis] : params.domain_min[axis]);
        glm::dvec3 normal(0.0);
        normal[axis] = at_max ? -1.0 : 1.0;
        body(normal[axis] * (position[axis] - plane), normal);
    }
}

/// A set of borders, at most one an axis, beyond which an image of a particle lies: bits as in SphParams::wall_mask,
/// and bit 6 + axis where that axis is periodic, so that the image is shifted by the domain's length instead of
/// reflected. 0 is the particle itself.
using Reflection = std::uint32_t;

[[nodiscard]] inline bool is_shifted(Reflection walls, int axis)
{
    return (walls >> (6 + axis) & 1u) != 0u;
}

[[nodiscard]] inline glm::dvec3 reflect_position(const shared::SphParams& params, Reflection walls, glm::dvec3 position)
{
    for (int axis = 0; axis < 3; ++axis) {
        if (is_shifted(walls, axis)) {
            const double length =
                static_cast<double>(params.domain_max[axis]) - static_cast<double>(params.domain_min[axis]);
            position[axis] += (walls >> (2 * axis) & 1u) != 0u ? length : -length;
        } else if ((walls >> (2 * axis) & 1u) != 0u) {
            position[axis] = 2.0 * static_cast<double>(params.domain_min[axis]) - position[axis];
        } else if ((walls >> (2 * axis + 1) & 1u) != 0u) {
            position[axis] = 2.0 * static_cast<double>(params.domain_max[axis]) - position[axis];
        }
    }
    return position;
}

[[nodiscard]] inline glm::dvec3 reflect_velocity(Reflection walls, glm::dvec3 velocity)
{
    for (int axis = 0; axis < 3; ++axis) {
        if ((walls >> (2 * axis) & 3u) != 0u && !is_shifted(walls, axis)) {
            velocity[axis] = -velocity[axis];
        }
    }
    return velocity;
}

/// Twin of include/periodic.glsl: a position, back in the domain along periodic axes.
[[nodiscard]] inline glm::dvec3 wrap_position(const shared::SphParams& params, glm::dvec3 position)
{
    for (int axis = 0; axis < 3; ++axis) {
        const double min = static_cast<double>(params.domain_min[axis]);
        const double max = static_cast<double>(params.domain_max[axis]);
        if ((params.periodic_mask >> (2 * axis) & 1u) != 0u && position[axis] < min) {
            position[axis] += max - min;
        } else if ((params.periodic_mask >> (2 * axis) & 1u) != 0u && position[axis] >= max) {
            position[axis] -= max - min;
        }
    }
    return position;
}

/// Twin of the same: along a unit vector that is an axis or its opposite.
[[nodiscard]] inline bool is_periodic_along(const shared::SphParams& params, const glm::vec3& along)
{
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(along[axis]) > 0.5f && (params.periodic_mask >> (2 * axis) & 1u) != 0u) {
            return true;
        }
    }
    return false;
}

/// Twin of the same: a texel beyond a map's border is that at the border, or, where space is periodic, at the other
/// one.
[[nodiscard]] inline int inside(int i, int count, bool is_periodic)
{
    return is_periodic ? (i + count) % count : std::clamp(i, 0, count - 1);
}

/// Of a wall with that inward normal, m/s: only the lid moves.
[[nodiscard]] inline glm::dvec3 wall_velocity(const shared::SphParams& params, const glm::dvec3& normal)
{
    return normal.y < 0.0 ? glm::dvec3(params.lid_velocity) : glm::dvec3(0.0);
}

} // namespace meltpoint::reference
