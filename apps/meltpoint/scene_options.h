#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "gpu/context.h"
#include "scene/scene.h"

namespace meltpoint::program {

/// Flags of every subcommand that works on a scene on a device.
struct SceneOptions {
    std::string scene;
    std::vector<std::string> overrides;
    std::string look; ///< of a mesh that is given instead of a scene; empty: the default
    std::string mesh; ///< instead of every mesh of the scene; empty: keeps them
    std::string device;
    bool validate = false;
};

/// --device and --validate alone.
void add_device_options(CLI::App& command, SceneOptions& options);
/// --set alone.
void add_set_option(CLI::App& command, SceneOptions& options);

/// All of them.
void add_scene_options(CLI::App& command, SceneOptions& options);

[[nodiscard]] Scene load_scene(const SceneOptions& options);
[[nodiscard]] gpu::ContextOptions context_options(const SceneOptions& options);

/// Throws Runtime with the first message when the validation layers had anything to say.
void require_silent_validation(const gpu::Context& context);

} // namespace meltpoint::program
