#pragma once

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
    std::string_view name;  ///< "physics.viscosity"; of a [[fluid]] without the prefix: "velocity"
    std::string_view shape; ///< of a [[fluid]]: the one shape that has this key, empty for all
    bool required = false;  ///< has no default
    std::string_view unit;  ///< empty when there is none
    std::string_view description;
    ValueRule rule;
    std::function<SceneValue(const Owner&)> get;
    std::function<void(Owner&, const SceneValue&)> set; ///< the value must be one that the rule accepts
};

using SceneKey = Key<Scene>;
using FluidKey = Key<FluidBody>;

/// In the order in which they are written. A fluid's first key is "shape"; the keys of a shape may only be used on a
/// body that has it.
std::span<const SceneKey> scene_keys();
std::span<const FluidKey> fluid_keys();

/// The name of the body's shape: "block", "sphere" or "mesh".
std::string_view shape_name(const FluidBody& body);

} // namespace meltpoint
