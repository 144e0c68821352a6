#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// Reads the triangles of a mesh file, of the format that its name ends in: .obj, .ply, .stl, .gltf, .glb or .off.
/// Polygons are triangulated, the transforms of nodes applied, vertices welded (weld() says what becomes of the file's
/// vertex normals and colors), the whole validated. Colors are read from .obj, .ply, .gltf and .glb: where only some of
/// the vertices have one, the others are white; where none has, there are none. Lines, points, materials and other
/// files that it names are ignored, except for the buffers of glTF. A file that is missing, unreadable, larger than 2
/// GiB, of another format, broken, cut off, or without a usable surface is an Input error that names file and reason;
/// memory and time stay in proportion to the file.
[[nodiscard]] TriangleMesh import_mesh(const std::filesystem::path& path);

/// The same of a file's bytes, as if they stood at `path`.
[[nodiscard]] TriangleMesh parse_mesh(std::span<const std::uint8_t> bytes, const std::filesystem::path& path);

} // namespace meltpoint
