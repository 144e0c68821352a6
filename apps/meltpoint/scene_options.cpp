#include "scene_options.h"

#include <algorithm>

#include <fmt/ranges.h>

#include "core/error.h"
#include "core/log.h"
#include "run/mesh_scene.h"

namespace meltpoint::program {

void add_device_options(CLI::App& command, SceneOptions& options)
{
    command
        .add_option("--device", options.device,
                    "Vulkan device, by index or part of its name (see meltpoint info) [best usable]")
        ->type_name("NAME|INDEX");
    command.add_flag("--validate", options.validate,
                     "Vulkan validation and synchronization validation; any warning or error ends in exit code 1");
}

void add_set_option(CLI::App& command, SceneOptions& options)
{
    command
        .add_option("--set", options.overrides,
                    "Changes a key of the scene, KEY=VALUE: dotted keys, TOML values (physics.viscosity=0.1, "
                    "domain.max=[1,2,1], fluid.0.velocity=[0,1,0]); may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

void add_scene_options(CLI::App& command, SceneOptions& options)
{
    command
        .add_option("SCENE", options.scene,
                    "A scene file (.toml), the name of a built-in scene, or a mesh or a scan (a file or "
                    "builtin:NAME) with a look")
        ->required();
    command
        .add_option("--look", options.look,
                    "What becomes of a mesh or scan that is given as SCENE: drop, filled with fluid; melt, ice in the "
                    "sun; dune, sand in the wind; vanish, dust that drifts; wash, stone in a jet [drop]")
        ->type_name("LOOK");
    add_set_option(command, options);
    command
        .add_option(
            "--mesh", options.mesh,
            "A mesh or a scan (a file or builtin:NAME) that takes the place of every mesh of the scene, with its "
            "size and place")
        ->type_name("MESH");
    add_device_options(command, options);
}

namespace {

std::optional<Look> find_look(const std::string& name)
{
    if (name.empty()) {
        return std::nullopt;
    }
    const auto found = std::ranges::find(look_names(), name, &LookName::name);
    if (found == look_names().end()) {
        std::vector<std::string_view> names;
        std::ranges::transform(look_names(), std::back_inserter(names), &LookName::name);
        throw input_error("--look {}: there is no such look: {}", name, fmt::join(names, ", "));
    }
    return found->look;
}

} // namespace

Scene load_scene(const SceneOptions& options)
{
    Scene scene = find_scene(options.scene, options.overrides, find_look(options.look));
    if (!options.mesh.empty() && replace_meshes(scene, options.mesh) == 0) {
        throw input_error("--mesh: the scene {} has no mesh whose place {} could take", scene.name, options.mesh);
    }
    return scene;
}

gpu::ContextOptions context_options(const SceneOptions& options)
{
    return {.device = options.device, .validation = options.validate};
}

void require_silent_validation(const gpu::Context& context)
{
    const std::vector<std::string> messages = context.validation_messages();
    if (messages.empty()) {
        return;
    }
    for (const std::string& message : messages) {
        log_error("Vulkan validation: " + message);
    }
    throw runtime_error("Vulkan validation reported {} message{}", messages.size(), messages.size() == 1 ? "" : "s");
}

} // namespace meltpoint::program
