// Cleary & Monaghan, "Conduction Modelling Using Smoothed Particle Hydrodynamics", J. Comput. Phys. 148, 1999.
#include "reference/heat.h"

#include <algorithm>
#include <cmath>

#include "core/parallel_for.h"
#include "particles/sph_kernel.h"
#include "reference/walls.h"

namespace meltpoint::reference {
namespace {

bool is_in_state(const State& state, std::size_t i, std::uint32_t which)
{
    return shared::particle_state(state.attributes[i]) == which;
}

bool keeps_heat(const State& state, std::size_t i)
{
    return is_in_state(state, i, shared::STATE_FLUID) || is_in_state(state, i, shared::STATE_SOLID);
}

/// m^3/kg, at rest: a solid's is its own.
double specific_volume(const Settings& settings, const State& state, std::size_t i)
{
    return state.weight[i] / rest_density(settings, state, i);
}

/// What the others see of a particle.
struct Thermal {
    double temperature = 0.0;  // degrees C
    double conductivity = 0.0; // W/(m K)
    double volume = 0.0;       // m^3
};

Thermal thermal_of(const Settings& settings, const shared::HeatParams& heat, const State& state, std::size_t i,
                   double enthalpy)
{
    const bool collider = is_in_state(state, i, shared::STATE_COLLIDER);
    if (!collider && !keeps_heat(state, i)) {
        return {};
    }
    const shared::HeatMaterial& material = heat.of[shared::particle_material(state.attributes[i])];
    return {.temperature = temperature(material, enthalpy),
            .conductivity = conductivity(material, enthalpy),
            .volume = collider ? state.weight[i] * static_cast<double>(settings.params.lattice_volume)
                               : state.mass[i] * specific_volume(settings, state, i)};
}

} // namespace

double temperature(const shared::HeatMaterial& material, double enthalpy)
{
    const double melting_point = static_cast<double>(material.melting_point);
    const double latent_heat = static_cast<double>(material.latent_heat);
    if (enthalpy < 0.0) {
        return melting_point + enthalpy / static_cast<double>(material.solid_specific_heat);
    }
    return melting_point + std::max(enthalpy - latent_heat, 0.0) / static_cast<double>(material.fluid_specific_heat);
}

double conductivity(const shared::HeatMaterial& material, double enthalpy)
{
    const double latent_heat = static_cast<double>(material.latent_heat);
    const double molten = enthalpy > 0.0 ? 1.0 : 0.0;
    const double melted = latent_heat > 0.0 ? std::clamp(enthalpy / latent_heat, 0.0, 1.0) : molten;
    return std::lerp(static_cast<double>(material.solid_conductivity), static_cast<double>(material.fluid_conductivity),
                     melted);
}

void conduct(const Settings& settings, const shared::HeatParams& heat, const State& state, const Neighbors& neighbors,
             std::span<double> enthalpy, double dt)
{
    const double support_radius = static_cast<double>(settings.params.support_radius);
    const double nearest =
        static_cast<double>(shared::NEAREST_CONDUCTION) * static_cast<double>(settings.params.spacing);
    std::vector<Thermal> thermal(state.size());
    for (std::size_t i = 0; i < state.size(); ++i) {
        thermal[i] = thermal_of(settings, heat, state, i, enthalpy[state.id[i]]);
    }
    parallel_for(state.size(), [&](std::size_t i) {
        if (!keeps_heat(state, i) || thermal[i].conductivity == 0.0) {
            return;
        }
        double sum = 0.0; // W/m^3
        for (const Neighbor& neighbor : neighbors.of(i)) {
            const Thermal& other = thermal[neighbor.index];
            if (other.conductivity == 0.0) {
                continue;
            }
            const glm::dvec3 image =
                reflect_position(settings.params, neighbor.reflection, state.position[neighbor.index]);
            const double r = std::max(glm::length(state.position[i] - image), nearest);
            const double slope = -static_cast<double>(settings.params.gradient_scale) *
                                 gradient_shape(settings.kernel, r / support_radius); // W'(r)
            const double pair_conductivity =
                4.0 * thermal[i].conductivity * other.conductivity / (thermal[i].conductivity + other.conductivity);
            sum += other.volume * pair_conductivity * (other.temperature - thermal[i].temperature) * -slope / r;
        }
        enthalpy[state.id[i]] += dt * sum * specific_volume(settings, state, i);
    });
}

double heat_content(const State& state, std::span<const double> enthalpy)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        sum += keeps_heat(state, i) ? state.mass[i] * enthalpy[state.id[i]] : 0.0;
    }
    return sum;
}

} // namespace meltpoint::reference
