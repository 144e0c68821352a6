#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "scene/scene.h"
#include "scene/scene_value.h"

namespace meltpoint {

/// One key of a scene file and the field that it stands for. Reading, checking, overriding, writing and documenting a
/// scene are all driven by the two tables below: a new setting is one field in scene.h and one line there. A key's
/// default is what get() finds in a default-constructed owner.
template <class Owner>
struct Key {
    std::string_view
        name; ///< "physics.viscosity"; of a body ([[fluid]], [[solid]] and so on) without the prefix: "velocity"
    std::string_view shape; ///< of a body: the one shape that has this key, empty for all
    bool required = false;  ///< has no default
    std::string_view unit;  ///< empty when there is none
    std::string_view description;
    ValueRule rule;
    std::function<SceneValue(const Owner&)> get;
    std::function<void(Owner&, const SceneValue&)> set; ///< the value must be one that the rule accepts
};

using SceneKey = Key<Scene>;
using FluidKey = Key<FluidBody>;
using SolidKey = Key<SolidBody>;
using EmitterKey = Key<EmitterBody>;
using SinkKey = Key<SinkBody>;
using ColliderKey = Key<ColliderBody>;
using SurfaceKey = Key<SurfaceBody>;

/// In the order in which they are written. A body's first key is "shape"; the keys of a shape may only be used on a
/// body that has it.
std::span<const SceneKey> scene_keys();
std::span<const FluidKey> fluid_keys();
std::span<const SolidKey> solid_keys();
std::span<const EmitterKey> emitter_keys();
std::span<const SinkKey> sink_keys();
std::span<const ColliderKey> collider_keys();
std::span<const SurfaceKey> surface_keys();

constexpr std::string_view shape_word(const BlockShape&)
{
    return "block";
}
constexpr std::string_view shape_word(const SphereShape&)
{
    return "sphere";
}
constexpr std::string_view shape_word(const MeshShape&)
{
    return "mesh";
}
constexpr std::string_view shape_word(const JetShape&)
{
    return "jet";
}
constexpr std::string_view shape_word(const InflowShape&)
{
    return "inflow";
}
constexpr std::string_view shape_word(const RainShape&)
{
    return "rain";
}

/// Its name in the file: "block", "sphere", "mesh", "jet", "inflow" or "rain".
template <class... Shapes>
[[nodiscard]] std::string_view shape_name(const std::variant<Shapes...>& shape)
{
    return std::visit([](const auto& alternative) { return shape_word(alternative); }, shape);
}

/// The key of that name, null if there is none.
template <class Owner>
[[nodiscard]] const Key<Owner>* find_key(std::span<const Key<Owner>> keys, std::string_view name)
{
    const auto found = std::ranges::find(keys, name, &Key<Owner>::name);
    return found == keys.end() ? nullptr : &*found;
}

/// Does a body of that shape have this key?
template <class Body>
[[nodiscard]] bool belongs_to(const Key<Body>& key, std::string_view shape)
{
    return key.shape.empty() || key.shape == shape;
}

/// The key of that name of a body of that shape; if it has none, that of another shape.
template <class Body>
[[nodiscard]] const Key<Body>* find_key(std::span<const Key<Body>> keys, std::string_view name, std::string_view shape)
{
    const auto found =
        std::ranges::find_if(keys, [&](const Key<Body>& key) { return key.name == name && belongs_to(key, shape); });
    return found == keys.end() ? find_key(keys, name) : &*found;
}

/// Calls visit(name, bodies, keys) for each of a scene's arrays of bodies: name is that of its [[tables]].
template <class AnyScene, class Visit>
void for_each_body_list(AnyScene& scene, const Visit& visit)
{
    visit(std::string_view("fluid"), scene.fluids, fluid_keys());
    visit(std::string_view("solid"), scene.solids, solid_keys());
    visit(std::string_view("emitter"), scene.emitters, emitter_keys());
    visit(std::string_view("sink"), scene.sinks, sink_keys());
    visit(std::string_view("collider"), scene.colliders, collider_keys());
    visit(std::string_view("surface"), scene.surfaces, surface_keys());
}

} // namespace meltpoint
