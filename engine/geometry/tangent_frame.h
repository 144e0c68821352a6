#pragma once

#include <cmath>

#include <glm/glm.hpp>

namespace meltpoint {

/// Two unit vectors that are perpendicular to a normal and to each other: u x v is the normal.
struct TangentFrame {
    glm::dvec3 u;
    glm::dvec3 v;

    /// Duff, Burgess, Christensen, Hery, Kensler, Liani & Villemin 2017, "Building an orthonormal basis, revisited".
    /// The normal must be of unit length.
    explicit TangentFrame(const glm::dvec3& normal)
    {
        const double sign = std::copysign(1.0, normal.z);
        const double a = -1.0 / (sign + normal.z);
        const double b = normal.x * normal.y * a;
        u = {1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
        v = {b, sign + normal.y * normal.y * a, -normal.y};
    }
};

} // namespace meltpoint
