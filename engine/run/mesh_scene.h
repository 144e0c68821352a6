#pragma once

#include <span>
#include <string>

#include "scene/scene.h"

namespace meltpoint {

/// The scene that a name on the command line means: the name of a built-in scene (a file called so is ./NAME), a scene
/// file (.toml), a file of a mesh or of points, or builtin:MESH (mesh_scene). Overrides are "key=value" as in
/// scene_file.h. Throws Input, naming what there is.
[[nodiscard]] Scene find_scene(const std::string& name, std::span<const std::string> overrides);

/// A mesh or a scan (load_surface) filled with about 16,000 particles of fluid and dropped from 0.4 times its size into
/// a box scaled to it. Viscosity and frame rate follow its size (Froude's similarity), so that a thimble and a house
/// splash alike. Throws Input for what cannot be read, encloses no volume or is not 0.001 to 2000 m large.
[[nodiscard]] Scene mesh_scene(const std::string& name);

/// Puts a mesh or a scan (a path or "builtin:NAME", not looked at yet) in the place of every mesh of a scene, which
/// keeps its size and position. Returns how many that were.
std::size_t replace_meshes(Scene& scene, const std::string& mesh);

} // namespace meltpoint
