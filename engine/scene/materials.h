#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "scene/liquids.h"
#include "scene/scene.h"

namespace meltpoint {

/// What the particles of a fluid, a solid or a collider share: an entry of the device's material table.
struct Material {
    float rest_density = 0.0f;   ///< kg/m^3; 0 for colliders, which have no mass
    glm::vec3 color{0.0f};       ///< linear RGB
    float friction = 0.0f;       ///< Pa s, of fluid against a collider
    float viscosity = 0.0f;      ///< Pa s, of fluids
    float tension = 0.0f;        ///< N/m, of fluids
    float contact_angle = 0.0f;  ///< degrees, of fluid at a collider or solid
    glm::vec3 solid_color{0.0f}; ///< linear RGB, of solids
    ThermalProperties thermal{}; ///< where heat is followed
    float temperature = 0.0f;    ///< degrees C, at the start
    bool melts = false;
    float absorptivity = 0.0f; ///< of the sun's power, of solids
    bool wind_erodes = false;
    SandProperties sand{};
    float sand_grain = 0.0f;                  ///< m, of sand
    Erodibility erosion{};                    ///< of solids that flow erodes
    SolidAnchor anchor = SolidAnchor::Ground; ///< of solids
    float sliding_friction = 0.0f;            ///< mu, of solids

    bool operator==(const Material&) const = default;
};

struct SceneMaterials {
    std::vector<Material> materials;        ///< distinct, in order of first use
    std::vector<std::uint32_t> of_fluid;    ///< for each Scene::fluids, its index into materials
    std::vector<std::uint32_t> of_solid;    ///< likewise for Scene::solids
    std::vector<std::uint32_t> of_emitter;  ///< likewise for Scene::emitters
    std::vector<std::uint32_t> of_collider; ///< likewise for Scene::colliders
};

/// sigma of a fluid, N/m, where it is a force in SI units. A named liquid brings its own; it is left out where drops
/// and waves that it would shape are finer than the particles, the capillary length sqrt(sigma / (rho g)) being shorter
/// than a spacing.
inline float tension_of(const Scene& scene, const FluidBody& body)
{
    if (scene.physics.tension_model != TensionModel::Si) {
        return 0.0f;
    }
    const Liquid* liquid = find_liquid(body.liquid);
    if (body.surface_tension || liquid == nullptr) {
        return body.surface_tension.value_or(scene.physics.surface_tension);
    }
    const float spacing = scene.particles.spacing;
    const float weight = body.rest_density * glm::length(scene.physics.gravity) * spacing * spacing;
    return liquid->surface_tension >= weight ? liquid->surface_tension : 0.0f;
}

/// degrees C, of a fluid or solid at the start.
inline float start_temperature(const Scene& scene, const FluidBody& body, bool is_solid)
{
    const float air = scene.heat.air_temperature;
    const float melting_point = body.thermal.melting_point;
    return body.temperature.value_or(is_solid ? std::min(air, melting_point) : std::max(air, melting_point));
}

/// Fluids of equal rest density, viscosity, tension and color are one material, and so are colliders of equal color,
/// friction and contact angle, and solids that are equal in all of these; where heat is followed they are equal in
/// that, too. A solid keeps its material as a fluid.
inline SceneMaterials scene_materials(const Scene& scene)
{
    SceneMaterials result;
    const auto index_of = [&](const Material& material) {
        const auto found = std::find(result.materials.begin(), result.materials.end(), material);
        const auto index = static_cast<std::uint32_t>(found - result.materials.begin());
        if (found == result.materials.end()) {
            result.materials.push_back(material);
        }
        return index;
    };
    const auto fluid_material = [&](const FluidBody& body) {
        return Material{.rest_density = body.rest_density,
                        .color = body.color,
                        .viscosity = body.viscosity.value_or(scene.physics.viscosity),
                        .tension = tension_of(scene, body)};
    };
    const bool heat = has_heat(scene);
    const auto warm_material = [&](const FluidBody& body, bool is_solid) {
        Material material = fluid_material(body);
        if (heat) {
            material.thermal = body.thermal;
            material.temperature = start_temperature(scene, body, is_solid);
        }
        return material;
    };
    for (const FluidBody& body : scene.fluids) {
        result.of_fluid.push_back(index_of(warm_material(body, false)));
    }
    for (const SolidBody& body : scene.solids) {
        Material material = warm_material(body, true);
        material.melts = body.melts;
        material.absorptivity = heat ? body.absorptivity : 0.0f;
        material.wind_erodes = body.wind_erodes;
        material.sand = body.wind_erodes ? body.sand : SandProperties{};
        material.sand_grain = body.wind_erodes ? body.erosion.grain_size.value_or(usual_sand_grain) : 0.0f;
        material.erosion = body.erosion.erodes ? body.erosion : Erodibility{};
        material.friction = body.friction;
        material.contact_angle = body.contact_angle;
        material.solid_color = body.solid_color;
        material.anchor = anchor_of(body);
        material.sliding_friction = body.sliding_friction;
        result.of_solid.push_back(index_of(material));
    }
    for (const EmitterBody& body : scene.emitters) {
        result.of_emitter.push_back(index_of(warm_material(body.fluid, false)));
    }
    for (const ColliderBody& body : scene.colliders) {
        Material material{.color = body.color, .friction = body.friction, .contact_angle = body.contact_angle};
        material.thermal = {.conductivity = 0.0f, .solid_conductivity = body.temperature ? body.conductivity : 0.0f};
        material.temperature = body.temperature.value_or(0.0f);
        result.of_collider.push_back(index_of(material));
    }
    return result;
}

} // namespace meltpoint
