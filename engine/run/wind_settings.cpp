#include "run/wind_settings.h"

#include "scene/materials.h"

namespace meltpoint {

std::optional<sim::WindSettings> wind_settings(const Scene& scene)
{
    if (!has_sand(scene)) {
        return std::nullopt;
    }
    const WindSettings& wind = scene.wind;
    sim::WindSettings settings{.direction = wind.direction,
                               .friction_velocity = static_cast<double>(wind.friction_velocity),
                               .roughness_length = static_cast<double>(wind.roughness_length),
                               .air_density = static_cast<double>(wind.air_density),
                               .flux = static_cast<double>(wind.flux),
                               .hop_length = static_cast<double>(wind.hop_length),
                               .time_scale = static_cast<double>(wind.time_scale)};
    const std::vector<Material> materials = scene_materials(scene).materials;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const SandProperties& sand = materials[i].sand;
        settings.sand[i] = {.erodes = materials[i].wind_erodes,
                            .grain_size = static_cast<double>(materials[i].sand_grain),
                            .grain_density = static_cast<double>(sand.grain_density),
                            .cohesion = static_cast<double>(sand.cohesion),
                            .repose_angle = static_cast<double>(sand.repose_angle)};
    }
    return settings;
}

} // namespace meltpoint
