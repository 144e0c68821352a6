#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// Reads an ASCII OFF file, the object file format of Geomview (Phillips 1992), with the prefixes ST, C, N, 4 and n
/// (dimension 3 only): positions, the normals of N, polygons cut into triangles; colors and texture coordinates are
/// ignored. Whatever is broken, cut off or points outside the file is an Input error that begins with `name`.
/// Coordinates may be not finite.
[[nodiscard]] TriangleMesh read_off(std::span<const std::uint8_t> bytes, const std::string& name);

} // namespace meltpoint
