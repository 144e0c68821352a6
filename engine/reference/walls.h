#pragma once

#include <glm/glm.hpp>

#include "reference/state.h"

namespace meltpoint::reference {

/// Calls body(signed distance in meters, positive inside; inward unit normal; wall number 0..5) for every wall of the
/// domain.
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
        body(normal[axis] * (position[axis] - plane), normal, wall);
    }
}

/// No wall has this number: leave_out for a product over all walls.
inline constexpr int NO_WALL = -1;

/// Fraction of the kernel that lies inside all walls but leave_out: the product over the walls of what each leaves.
/// That is exact for one wall, and in a corner as good as the kernel is close to a product of functions of x, y and z.
[[nodiscard]] double inside_fraction(const Settings& settings, const glm::dvec3& position, int leave_out = NO_WALL);

} // namespace meltpoint::reference
