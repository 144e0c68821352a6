#include "run/heat_settings.h"

#include "scene/materials.h"

namespace meltpoint {

namespace {

shared::HeatMaterial heat_material(const Material& material)
{
    const ThermalProperties& its = material.thermal;
    return {.solid_conductivity = its.solid_conductivity,
            .fluid_conductivity = its.conductivity,
            .solid_specific_heat = its.solid_specific_heat,
            .fluid_specific_heat = its.specific_heat,
            .latent_heat = its.latent_heat,
            .melting_point = its.melting_point};
}

} // namespace

std::optional<sim::MeltingSettings> melting_settings(const Scene& scene, const ParticleSet& particles)
{
    if (!has_heat(scene)) {
        return std::nullopt;
    }
    sim::MeltingSettings settings{.time_scale = static_cast<double>(scene.heat.time_scale)};
    shared::MeltingParams& params = settings.params;
    params.sun_direction = glm::normalize(scene.heat.sun_direction);
    params.sun = scene.heat.sun;
    params.air_temperature = scene.heat.air_temperature;
    params.air_transfer = scene.heat.air_transfer;
    const std::vector<Material> materials = scene_materials(scene).materials;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        settings.heat.of[i] = heat_material(materials[i]);
        params.absorptivity[i] = materials[i].absorptivity;
        params.melts[i] = materials[i].melts ? 1 : 0;
        params.birth_enthalpy[i] =
            materials[i].thermal.latent_heat +
            materials[i].thermal.specific_heat * (materials[i].temperature - materials[i].thermal.melting_point);
    }
    settings.enthalpy.resize(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const std::uint32_t number = shared::particle_material(particles.attributes[i]);
        const Material& material = materials[number];
        const double above =
            static_cast<double>(material.temperature) - static_cast<double>(material.thermal.melting_point);
        const std::uint32_t state = shared::particle_state(particles.attributes[i]);
        const bool is_fluid = state == shared::STATE_FLUID || state == shared::STATE_DEAD; // who will be fluid
        // Of colliders, too: they keep their temperature, whatever their enthalpy is called.
        settings.enthalpy[i] = is_fluid || above > 0.0
                                   ? static_cast<double>(material.thermal.latent_heat) +
                                         static_cast<double>(material.thermal.specific_heat) * above
                                   : static_cast<double>(material.thermal.solid_specific_heat) * above;
    }
    return settings;
}

} // namespace meltpoint
