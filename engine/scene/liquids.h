#pragma once

#include <optional>
#include <span>
#include <string_view>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace meltpoint {

/// A liquid that a scene may name instead of giving its values.
struct Liquid {
    std::string_view name;
    float rest_density;                       ///< kg/m^3
    float viscosity;                          ///< dynamic, Pa s
    float surface_tension;                    ///< against air, N/m
    glm::vec3 color;                          ///< linear RGB
    std::optional<ThermalProperties> thermal; ///< of those who melt at one temperature
};

/// At 20 C, lava at 1,200 C.
[[nodiscard]] std::span<const Liquid> liquids();

/// The liquid of that name, null if there is none.
[[nodiscard]] const Liquid* find_liquid(std::string_view name);

/// Gives a fluid the name and the values of a liquid.
void set_liquid(FluidBody& body, const Liquid& liquid);

} // namespace meltpoint
