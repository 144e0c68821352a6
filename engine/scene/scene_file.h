#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace meltpoint {

/// Scenes as TOML 1.0 texts. apps/scenes/README.md lists every key with its unit, default and range.
///
/// Overrides are "key=value" texts with dotted keys and TOML values, applied in order before anything is checked:
/// "physics.viscosity=0.1", "domain.max=[1, 2, 1]", "fluid.0.velocity=[0, 1, 0]" (fluids count from 0),
/// "kernel=wendland" (a bare word is a string).
///
/// Every mistake is an Error (Input): "FILE:LINE: key "physics.viscosty" is unknown; did you mean
/// "physics.viscosity"?". It names file and line, or the override; the key; what was found; and what is allowed. The
/// result has passed validate_scene.

/// Reads a scene of at most 16 MiB. Paths of meshes are relative to the file's folder.
Scene read_scene_file(const std::filesystem::path& path, std::span<const std::string> overrides = {});

/// Reads a scene from memory; source_name stands for the file in messages. Paths of meshes become absolute: those in
/// the text are relative to base_dir, those in overrides to the working directory. "builtin:NAME" stays as it is.
Scene parse_scene(std::string_view toml, const std::string& source_name, const std::filesystem::path& base_dir,
                  std::span<const std::string> overrides = {});

/// The scene with every key written out: parse_scene(write_scene(scene)) equals it bit for bit. Throws like
/// validate_scene.
std::string write_scene(const Scene& scene);

/// The scenes of apps/scenes, compiled in, in alphabetical order.
std::vector<std::string> builtin_scene_names();
Scene builtin_scene(std::string_view name, std::span<const std::string> overrides = {});

} // namespace meltpoint
