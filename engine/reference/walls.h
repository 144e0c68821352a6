#pragma once

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

/// A set of walls, at most one an axis, that a particle is reflected across: bits as in SphParams::wall_mask. 0 is the
/// particle itself.
using Reflection = std::uint32_t;

[[nodiscard]] inline glm::dvec3 reflect_position(const shared::SphParams& params, Reflection walls, glm::dvec3 position)
{
    for (int axis = 0; axis < 3; ++axis) {
        if ((walls >> (2 * axis) & 1u) != 0u) {
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
        if ((walls >> (2 * axis) & 3u) != 0u) {
            velocity[axis] = -velocity[axis];
        }
    }
    return velocity;
}

} // namespace meltpoint::reference
