#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// Reads an STL file, ASCII or binary (3D Systems 1988): three vertices of its own for each triangle, no normals, since
/// those of the file belong to its triangles, whose corners tell them better. Whatever is broken or cut off is an Input
/// error that begins with `name`. Coordinates may be not finite.
[[nodiscard]] TriangleMesh read_stl(std::span<const std::uint8_t> bytes, const std::string& name);

} // namespace meltpoint
