#pragma once

#include <filesystem>

#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// Reads the triangles of a mesh file (OBJ): polygons triangulated, the transforms of nodes applied, welded (weld()
/// says what becomes of normals) and validated. Lines, points, materials and other files that it names are ignored. A
/// file that is missing, unreadable, larger than 2 GiB, of another format, broken, or without a usable surface is an
/// Input error that names file and reason.
[[nodiscard]] TriangleMesh import_mesh(const std::filesystem::path& path);

} // namespace meltpoint
