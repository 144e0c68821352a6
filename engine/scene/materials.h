#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace meltpoint {

/// What the particles of a fluid share: an entry of the device's material table.
struct Material {
    float rest_density = 0.0f; ///< kg/m^3
    glm::vec3 color{0.0f};     ///< linear RGB

    bool operator==(const Material&) const = default;
};

struct SceneMaterials {
    std::vector<Material> materials;     ///< distinct, in order of first use
    std::vector<std::uint32_t> of_fluid; ///< for each Scene::fluids, its index into materials
};

/// Fluids of equal rest density and color are one material.
inline SceneMaterials scene_materials(const Scene& scene)
{
    SceneMaterials result;
    for (const FluidBody& body : scene.fluids) {
        const Material material{body.rest_density, body.color};
        std::size_t index = 0;
        while (index < result.materials.size() && result.materials[index] != material) {
            ++index;
        }
        if (index == result.materials.size()) {
            result.materials.push_back(material);
        }
        result.of_fluid.push_back(static_cast<std::uint32_t>(index));
    }
    return result;
}

} // namespace meltpoint
