#pragma once

#include <string>

#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// Whether it begins with "builtin:", which no path of a file does.
[[nodiscard]] bool is_builtin(const std::string& name);

/// The mesh that a scene or a command line names: "builtin:NAME" or the path of a file. Throws Input as builtin_mesh
/// and import_mesh do.
[[nodiscard]] TriangleMesh load_mesh(const std::string& name);

} // namespace meltpoint
