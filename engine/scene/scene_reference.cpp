#include "scene/scene_reference.h"

#include <fmt/format.h>

#include "scene/key_table.h"
#include "scene/liquids.h"
#include "scene/scene_file.h"

namespace meltpoint {

namespace {

constexpr std::string_view INTRODUCTION = R"(# Scenes

A scene is a [TOML](https://toml.io) file: all that a run needs. `meltpoint render drop.toml` runs a file, `meltpoint render
drop` the scene of this folder with that name, from anywhere. Start from a copy of one of these; teapot_drop is the default:

)";

constexpr std::string_view RULES = R"(
Every key may be left out unless it is marked required. Quantities are in SI units, y is up, angles are in degrees. Where
`"auto"` is allowed, the engine finds the value from the rest of the scene. Paths of meshes are relative to the scene's folder.

`--set key=value` changes any key for one run, with the dotted name of the tables below and a TOML value:
`--set physics.viscosity=0.1`, `--set domain.max=[1,2,1]`, `--set kernel=wendland`. Fluids, colliders and surfaces count from 0:
`--set fluid.0.velocity=[0,1,0]`. Paths of meshes are then relative to the folder in which the command runs.

This page is generated from the table of keys that also reads and checks scenes (engine/scene/key_table.cpp).
)";

/// Text for a cell of a table, in which a bar would end the cell.
std::string cell(std::string_view text)
{
    std::string escaped;
    for (const char c : text) {
        escaped += c == '|' ? std::string("\\|") : std::string(1, c);
    }
    return escaped;
}

template <class Owner>
std::string row(const Key<Owner>& key, const Owner& defaults)
{
    const std::string default_value = key.required ? "required" : fmt::format("`{}`", to_toml(key.get(defaults)));
    return fmt::format("| `{}` | {} | {} | {} |\n", key.name, default_value, cell(describe(key.rule, key.unit)),
                       cell(key.description));
}

constexpr std::string_view HEADER = "\n| key | default | allowed | meaning |\n| --- | --- | --- | --- |\n";

std::string_view table_of(std::string_view name)
{
    const std::size_t dot = name.find('.');
    return dot == std::string_view::npos ? std::string_view{} : name.substr(0, dot);
}

/// A body of the shape that has this key, everything else at its default.
template <class Body>
Body default_body(std::span<const Key<Body>> keys, const Key<Body>& key)
{
    Body body;
    if (!key.shape.empty()) {
        keys.front().set(body, SceneValue{std::string(key.shape)});
    }
    return body;
}

template <class Body>
std::string body_rows(std::span<const Key<Body>> keys, std::string_view shape)
{
    std::string text{HEADER};
    for (const Key<Body>& key : keys) {
        if (key.shape == shape) {
            text += row(key, default_body(keys, key));
        }
    }
    return text;
}

std::string_view about(std::string_view list)
{
    if (list == "fluid") {
        return "Once for each body of fluid. Where fluids overlap, the first one in the file keeps its place. Here the "
               "keys of every fluid; then those of its shape.";
    }
    if (list == "solid") {
        return "Once for each solid that may turn into fluid, if any. It stands still and is filled with particles as "
               "a "
               "fluid is, at the scene's spacing; whatever frees them, they keep their mass. Where bodies overlap, "
               "fluids come first, then solids in the order of the file. Here the keys of every solid; then those of "
               "its shape.";
    }
    if (list == "emitter") {
        return "Once for each place where fluid comes into the scene while it runs, if any, at most 16. A particle "
               "comes "
               "only where none is nearer than 0.85 spacings, so an emitter under water brings as much as flows off. "
               "Here the keys of every emitter; then those of its shape.";
    }
    if (list == "sink") {
        return "Once for each place where fluid and dust go out, if any, at most 16. Here the keys of every sink; then "
               "those of its shape.";
    }
    if (list == "collider") {
        return "Once for each solid that stands in the fluid's way, if any. What of it lies outside the domain is cut "
               "off. A block that is flat along one axis is a plate. A mesh may also be a scan: a file of points "
               "(.xyz, "
               "or .ply without faces). Here the keys of every collider; then those of its shape.";
    }
    return "Once for each surface that is shown as splats, if any: it is drawn, not simulated, and fluid passes "
           "through it. Plates and scans are allowed as for colliders. Here the keys of every surface; then those of "
           "its shape.";
}

/// What liquids there are.
std::string liquid_rows()
{
    std::string text =
        "\n### Liquids\n\n| liquid | rest_density, kg/m^3 | viscosity, Pa s | surface_tension, N/m | color |\n"
        "|---|---|---|---|---|\n";
    for (const Liquid& liquid : liquids()) {
        text += fmt::format("| `{}` | {} | {} | {} | [{}, {}, {}] |\n", liquid.name, liquid.rest_density,
                            liquid.viscosity, liquid.surface_tension, liquid.color.x, liquid.color.y, liquid.color.z);
    }
    text += "\nAt 20 C, and basaltic lava at 1,200 C. Those who melt at one temperature:\n\n"
            "| liquid | melting_point, C | latent_heat, J/kg | specific_heat, J/(kg K), fluid, solid | conductivity, "
            "W/(m K), fluid, solid |\n|---|---|---|---|---|\n";
    for (const Liquid& liquid : liquids()) {
        if (const auto& heat = liquid.thermal) {
            text += fmt::format("| `{}` | {} | {} | {}, {} | {}, {} |\n", liquid.name, heat->melting_point,
                                heat->latent_heat, heat->specific_heat, heat->solid_specific_heat, heat->conductivity,
                                heat->solid_conductivity);
        }
    }
    return text;
}

} // namespace

std::string scene_reference_markdown()
{
    std::string text{INTRODUCTION};
    for (const std::string& name : builtin_scene_names()) {
        text += fmt::format("- [{0}.toml]({0}.toml): {1}\n", name, builtin_scene(name).description);
    }
    text += std::string(RULES) + "\n## Top level\n" + std::string(HEADER);
    std::string_view table;
    const Scene defaults;
    for (const SceneKey& key : scene_keys()) {
        if (table_of(key.name) != table) {
            table = table_of(key.name);
            text += fmt::format("\n## [{}]\n{}", table, HEADER);
        }
        text += row(key, defaults);
    }
    for_each_body_list(defaults, [&](std::string_view list, const auto&, const auto& keys) {
        text += fmt::format("\n## [[{}]]\n\n{}\n", list, about(list)) + body_rows(keys, "");
        text += list == "fluid" ? liquid_rows() : "";
        for (const std::string_view shape : keys.front().rule.choices) {
            text += fmt::format("\n### shape = \"{}\"\n{}", shape, body_rows(keys, shape));
        }
    });
    return text;
}

} // namespace meltpoint
