#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace meltpoint {

/// What becomes of a mesh or a scan that is given without a scene.
enum class Look { Drop, Melt, Dune, Vanish, Wash };

/// A look's name on the command line.
struct LookName {
    std::string_view name;
    Look look;
};
[[nodiscard]] std::span<const LookName> look_names();

/// The scene that a name on the command line means: the name of a built-in scene (a file called so is ./NAME), a scene
/// file (.toml), a file of a mesh or of points, or builtin:MESH (mesh_scene, with that look, or dropped). Overrides are
/// "key=value" as in scene_file.h. Throws Input, naming what there is; a scene takes no look.
[[nodiscard]] Scene find_scene(const std::string& name, std::span<const std::string> overrides,
                               std::optional<Look> look = std::nullopt);

/// A mesh or a scan (load_surface) in a box scaled to it. Dropped, it is filled with about 16,000 particles of fluid
/// and falls from 0.4 times its size; in the other looks it is a solid of about 10,000 that stands on the floor.
/// Viscosity, speeds and frame rate follow its size (Froude's similarity), so that a thimble and a house splash alike.
/// Throws Input for what cannot be read, encloses no volume or is not 0.001 to 2000 m large.
[[nodiscard]] Scene mesh_scene(const std::string& name, Look look = Look::Drop);

/// Puts a mesh or a scan (a path or "builtin:NAME", not looked at yet) in the place of every mesh of a scene, which
/// keeps its size and position. Returns how many that were.
std::size_t replace_meshes(Scene& scene, const std::string& mesh);

} // namespace meltpoint
