#include "reference/melting.h"

#include <algorithm>
#include <cmath>

#include "particles/sph_kernel.h"
#include "reference/heat.h"
#include "shared/exposure.h"

namespace meltpoint::reference {

namespace {

/// Part of space that moving particles fill around x.
double fluid_filling(const Settings& settings, const State& state, const glm::dvec3& x)
{
    const double support_radius = static_cast<double>(settings.params.support_radius);
    double sum = 0.0;
    for (std::size_t j = 0; j < state.size(); ++j) {
        const double q = glm::distance(x, state.position[j]) / support_radius;
        if (!is_boundary(state, j) && q < 1.0) {
            sum += state.weight[j] * density_shape(settings.kernel, q);
        }
    }
    return sum * static_cast<double>(settings.params.lattice_volume) *
           static_cast<double>(settings.params.density_scale);
}

double specific_heat(const shared::HeatMaterial& material, double enthalpy)
{
    if (enthalpy < 0.0) {
        return static_cast<double>(material.solid_specific_heat);
    }
    return enthalpy > static_cast<double>(material.latent_heat) ? static_cast<double>(material.fluid_specific_heat)
                                                                : 0.0;
}

} // namespace

void warm(const Settings& settings, const shared::HeatParams& heat, const shared::MeltingParams& melting,
          const State& state, std::span<const glm::dvec4> exposure, std::span<const double> visibility,
          std::span<double> enthalpy, double seconds)
{
    const double transfer = static_cast<double>(melting.air_transfer);
    for (std::size_t i = 0; i < state.size(); ++i) {
        const std::uint32_t material = shared::particle_material(state.attributes[i]);
        double& its_enthalpy = enthalpy[state.id[i]];
        if (shared::particle_state(state.attributes[i]) == shared::STATE_DEAD) {
            its_enthalpy = static_cast<double>(melting.birth_enthalpy[material]);
        }
        const double area = exposure[i].w;
        if (shared::particle_state(state.attributes[i]) != shared::STATE_SOLID || area <= 0.0) {
            continue;
        }
        const glm::dvec3 normal(exposure[i]);
        const glm::dvec3 outside = state.position[i] + static_cast<double>(settings.params.spacing) * normal;
        const double cover =
            std::min(fluid_filling(settings, state, outside) / static_cast<double>(shared::COVER_FILLING), 1.0);
        const double facing = std::max(-glm::dot(normal, glm::dvec3(melting.sun_direction)), 0.0);
        const double from_sun = static_cast<double>(melting.sun) * static_cast<double>(melting.absorptivity[material]) *
                                facing * visibility[i];
        const double capacity = specific_heat(heat.of[material], its_enthalpy);
        const double decays =
            capacity > 0.0 ? (1.0 - cover) * transfer * area * seconds / (state.mass[i] * capacity) : 0.0;
        const double mean_decay = decays > 1e-9 ? -std::expm1(-decays) / decays : 1.0;
        const double from_air =
            transfer * (static_cast<double>(melting.air_temperature) - temperature(heat.of[material], its_enthalpy)) *
            mean_decay;
        its_enthalpy += (1.0 - cover) * area * (from_sun + from_air) * seconds / state.mass[i];
    }
}

std::size_t melt(const shared::HeatParams& heat, const shared::MeltingParams& melting, State& state,
                 std::span<const double> enthalpy, std::span<double> before, double ahead)
{
    std::size_t melted = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (shared::particle_state(state.attributes[i]) != shared::STATE_SOLID) {
            continue;
        }
        const std::uint32_t material = shared::particle_material(state.attributes[i]);
        const double now = enthalpy[state.id[i]];
        const double gain = std::max(now - before[state.id[i]], 0.0);
        before[state.id[i]] = now;
        if (melting.melts[material] != 0 && now + ahead * gain >= static_cast<double>(heat.of[material].latent_heat)) {
            state.attributes[i] = shared::freed_as(state.attributes[i], shared::STATE_FLUID, shared::CAUSE_MELT);
            ++melted;
        }
    }
    return melted;
}

std::size_t freeze(const Settings& settings, State& state, std::span<const double> enthalpy)
{
    const double reach = static_cast<double>(shared::FREEZING_DISTANCE) * static_cast<double>(settings.params.spacing);
    std::vector<std::size_t> frozen;
    std::vector<bool> loose(state.size(), false); // frozen to what is loose
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (shared::particle_state(state.attributes[i]) != shared::STATE_FLUID || enthalpy[state.id[i]] > 0.0) {
            continue;
        }
        const auto is_near = [&](const auto& is_one) {
            for (std::size_t j = 0; j < state.size(); ++j) {
                if (is_one(state.attributes[j]) && glm::distance(state.position[i], state.position[j]) < reach) {
                    return true;
                }
            }
            return false;
        };
        const bool at_still =
            is_near([](std::uint32_t each) { return shared::is_still(each) && !shared::is_gone(each); });
        loose[i] = !at_still && is_near(shared::is_loose);
        if (at_still || loose[i]) {
            frozen.push_back(i);
        }
    }
    for (const std::size_t i : frozen) {
        state.attributes[i] =
            shared::with_state(state.attributes[i], shared::STATE_SOLID) | (loose[i] ? shared::FLAG_LOOSE : 0u);
        state.velocity[i] = loose[i] ? state.velocity[i] : glm::dvec3(0.0);
    }
    return frozen.size();
}

} // namespace meltpoint::reference
