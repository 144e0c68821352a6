#include <algorithm>
#include <iterator>

#include "builtin_scenes.h"
#include "core/error.h"
#include "core/nearest_name.h"
#include "scene/scene_file.h"

namespace meltpoint {

std::vector<std::string> builtin_scene_names()
{
    std::vector<std::string> names;
    for (const BuiltinScene& scene : BUILTIN_SCENES) {
        names.emplace_back(scene.name);
    }
    return names;
}

Scene builtin_scene(std::string_view name, std::span<const std::string> overrides)
{
    const auto* scene = std::ranges::find(BUILTIN_SCENES, name, &BuiltinScene::name);
    if (scene == std::end(BUILTIN_SCENES)) {
        const std::vector<std::string> names = builtin_scene_names();
        const auto nearest = nearest_name(name, names);
        throw input_error("no built-in scene is called \"{}\"; {}", name,
                          nearest ? fmt::format("did you mean \"{}\"?", *nearest)
                                  : fmt::format("there are {}", fmt::join(names, ", ")));
    }
    return parse_scene(scene->toml, fmt::format("{}.toml", name), {}, overrides);
}

} // namespace meltpoint
