#pragma once

#include <string>
#include <variant>

#include "geometry/point_cloud.h"
#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// What a command line names: "builtin:NAME", or the path of a file of a mesh or of points (holds_points says which).
/// Throws Input as builtin_mesh, import_mesh and import_point_cloud do.
[[nodiscard]] std::variant<TriangleMesh, PointCloud> load_surface(const std::string& name);

} // namespace meltpoint
