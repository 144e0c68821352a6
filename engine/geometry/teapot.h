#pragma once

#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// The Utah teapot: 32 bicubic Bezier patches, each cut into resolution x resolution quads.
[[nodiscard]] TriangleMesh teapot(std::uint32_t resolution);

} // namespace meltpoint
