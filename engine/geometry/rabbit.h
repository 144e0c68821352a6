#pragma once

#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// A sitting rabbit of blended ellipsoids, looking along x, 2.15 m long and 2.25 m high, standing on y = 0. Closed,
/// without self-intersections.
[[nodiscard]] TriangleMesh rabbit();

} // namespace meltpoint
