#include "run/fragment_settings.h"

#include <algorithm>

#include "scene/materials.h"

namespace meltpoint {

namespace {

std::uint32_t anchor_number(SolidAnchor anchor)
{
    switch (anchor) {
    case SolidAnchor::All:
        return shared::ANCHOR_ALL;
    case SolidAnchor::None:
        return shared::ANCHOR_NONE;
    case SolidAnchor::Ground:
        break;
    }
    return shared::ANCHOR_GROUND;
}

} // namespace

std::optional<sim::FragmentSettings> fragment_settings(const Scene& scene)
{
    if (!has_fragments(scene)) {
        return std::nullopt;
    }
    sim::FragmentSettings settings;
    for (const FluidBody* body : fluid_bodies(scene)) {
        settings.params.fluid_density = std::max(settings.params.fluid_density, body->rest_density);
    }
    const std::vector<Material> materials = scene_materials(scene).materials;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        settings.params.anchor[i] = anchor_number(materials[i].anchor);
        settings.params.sliding_friction[i] = materials[i].sliding_friction;
    }
    return settings;
}

} // namespace meltpoint
