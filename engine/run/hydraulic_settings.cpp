#include "run/hydraulic_settings.h"

#include <algorithm>
#include <cmath>

#include "core/noise.h"
#include "core/parallel_for.h"
#include "run/color_strength.h"
#include "scene/materials.h"

namespace meltpoint {

namespace {

Grains grains_of(const Scene& scene, const Material& material)
{
    const FluidBody& fluid = *eroding_fluid(scene);
    return {.size = static_cast<double>(*material.erosion.grain_size),
            .density = static_cast<double>(material.rest_density),
            .fluid_density = static_cast<double>(fluid.rest_density),
            .viscosity = static_cast<double>(fluid.viscosity.value_or(scene.physics.viscosity)),
            .gravity = glm::length(glm::dvec3(scene.physics.gravity))};
}

} // namespace

double dimensionless_grain_size(const Grains& grains)
{
    const double buoyancy = grains.gravity * (grains.density / grains.fluid_density - 1.0);
    return grains.size * std::cbrt(buoyancy / std::pow(grains.viscosity / grains.fluid_density, 2.0));
}

double shields_threshold(const Grains& grains)
{
    const double size = dimensionless_grain_size(grains);
    const double shields = 0.30 / (1.0 + 1.2 * size) + 0.055 * (1.0 - std::exp(-0.020 * size));
    return shields * (grains.density - grains.fluid_density) * grains.gravity * grains.size;
}

std::vector<float> strengths(const Erodibility& erosion, std::span<const glm::vec3> positions, std::uint64_t seed)
{
    std::vector<float> result(positions.size(), 1.0f);
    const double grain = static_cast<double>(erosion.strength_grain);
    parallel_for(positions.size(), [&](std::size_t i) {
        glm::dvec3 x = glm::dvec3(positions[i]) / grain;
        if (erosion.strength_layers) { // the same all over a layer
            x = glm::dvec3(glm::dot(x, glm::normalize(glm::dvec3(*erosion.strength_layers))), 0.5, 0.5);
        }
        // Noise seldom comes near its bounds: half of them are enough for the strongest.
        const double power = std::clamp(2.0 * fractal_noise(x, seed), -1.0, 1.0);
        result[i] = static_cast<float>(std::pow(static_cast<double>(erosion.strength_contrast), power));
    });
    return result;
}

std::optional<sim::HydraulicSettings> hydraulic_settings(const Scene& scene, const ParticleSet& particles)
{
    if (!has_hydraulic(scene)) {
        return std::nullopt;
    }
    sim::HydraulicSettings settings;
    shared::HydraulicParams& params = settings.params;
    params.consistency = scene.hydraulic.consistency;
    params.flow_exponent = scene.hydraulic.exponent;
    params.time_scale = scene.hydraulic.time_scale;
    params.deposition_speed = scene.hydraulic.deposition_speed;
    params.deposition_time = scene.hydraulic.deposition_time;
    const SceneMaterials numbers = scene_materials(scene);
    const std::vector<Material>& materials = numbers.materials;
    settings.strength.assign(particles.size(), 1.0f);
    for (std::size_t m = 0; m < materials.size(); ++m) {
        const Erodibility& erosion = materials[m].erosion;
        params.erodes[m] = erosion.erodes ? 1 : 0;
        params.deposits[m] = erosion.erodes && erosion.deposits ? 1 : 0;
        params.threshold[m] = erosion.erodes && erosion.grain_size
                                  ? static_cast<float>(shields_threshold(grains_of(scene, materials[m])))
                                  : erosion.threshold;
        params.rate[m] = erosion.rate;
        params.exponent[m] = erosion.exponent;
        if (!erosion.erodes || erosion.strength_contrast == 1.0f) {
            continue;
        }
        const std::vector<float> found =
            erosion.strength_from == StrengthSource::Color
                ? color_strengths(colored_surfaces(scene, numbers, m), erosion.strength_contrast, particles.position)
                : strengths(erosion, particles.position, scene.seed + m);
        for (std::size_t i = 0; i < particles.size(); ++i) {
            if (shared::particle_material(particles.attributes[i]) == m) {
                settings.strength[i] = found[i];
            }
        }
    }
    return settings;
}

} // namespace meltpoint
