#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "scene/scene.h"
#include "scene/toml_entries.h"

namespace meltpoint {

/// The scene of a list of entries, each key checked by itself: known, of the right kind, in its range. Paths of meshes
/// are resolved against base_dir, those of overrides against the working directory. Throws Error (Input) that names the
/// entry's place, what was found and what is allowed.
[[nodiscard]] Scene build_scene(std::span<const TomlEntry> entries, const std::filesystem::path& base_dir);

/// "physics" of "physics.viscosity", empty for a top-level key.
[[nodiscard]] constexpr std::string_view table_of(std::string_view path)
{
    const std::size_t dot = path.rfind('.');
    return dot == std::string_view::npos ? std::string_view{} : path.substr(0, dot);
}

/// "viscosity" of "physics.viscosity"
[[nodiscard]] constexpr std::string_view leaf_of(std::string_view path)
{
    return path.substr(path.rfind('.') + 1);
}

/// Is it the name of an array of bodies: "fluid" or "collider"?
[[nodiscard]] bool is_body_list(std::string_view path);

} // namespace meltpoint
