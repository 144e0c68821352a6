#include "reference/hydraulic.h"

#include <algorithm>
#include <cmath>

#include "particles/sph_kernel.h"
#include "shared/exposure.h"

namespace meltpoint::reference {

namespace {

struct Flow {
    glm::dvec3 velocity{0.0}; ///< m/s, the mean
    double filling = 0.0;     ///< part of space that the fluid fills
};

Flow flow_at(const Settings& settings, const State& state, const glm::dvec3& x)
{
    const double support_radius = static_cast<double>(settings.params.support_radius);
    glm::dvec3 momentum(0.0);
    double sum = 0.0;
    for (std::size_t j = 0; j < state.size(); ++j) {
        const double q = glm::distance(x, state.position[j]) / support_radius;
        if (!is_boundary(state, j) && q < 1.0) {
            const double share = state.weight[j] * density_shape(settings.kernel, q);
            momentum += share * state.velocity[j];
            sum += share;
        }
    }
    return {.velocity = sum > 0.0 ? momentum / sum : glm::dvec3(0.0),
            .filling = sum * static_cast<double>(settings.params.lattice_volume) *
                       static_cast<double>(settings.params.density_scale)};
}

/// dD/dt, 1/s, of particle i.
double damage_rate(const Settings& settings, const shared::HydraulicParams& hydraulic, const State& state,
                   std::size_t i, const glm::dvec4& surface, double strength)
{
    const std::uint32_t material = shared::particle_material(state.attributes[i]);
    const double spacing = static_cast<double>(settings.params.spacing);
    const glm::dvec3 normal(surface);
    const Flow flow = flow_at(settings, state, state.position[i] + spacing * normal);
    const glm::dvec3 relative = flow.velocity - state.velocity[i];
    const double along = glm::length(relative - glm::dot(relative, normal) * normal);
    const double stress = static_cast<double>(hydraulic.consistency) *
                          std::pow(along / spacing, static_cast<double>(hydraulic.flow_exponent));
    const double excess = stress / strength - static_cast<double>(hydraulic.threshold[material]);
    if (excess <= 0.0) {
        return 0.0;
    }
    const double loss = static_cast<double>(hydraulic.rate[material]) *
                        std::pow(excess, static_cast<double>(hydraulic.exponent[material]));
    const double wet = std::min(flow.filling / static_cast<double>(shared::COVER_FILLING), 1.0);
    return static_cast<double>(hydraulic.time_scale) * wet * loss * surface.w / (strength * state.mass[i]);
}

/// Whether the way to what is there leads down; where there is no gravity, every way does.
bool is_below(const Settings& settings, const glm::dvec3& way)
{
    const glm::dvec3 gravity(settings.params.gravity);
    return glm::dot(way, gravity) >=
           static_cast<double>(shared::RESTING_COSINE) * glm::length(way) * glm::length(gravity);
}

bool rests_on_floor(const Settings& settings, const glm::dvec3& x)
{
    const shared::SphParams& params = settings.params;
    for (int border = 0; border < 6; ++border) {
        const int axis = border / 2;
        const bool is_low = border % 2 == 0;
        const double wall = static_cast<double>(is_low ? params.domain_min[axis] : params.domain_max[axis]);
        glm::dvec3 outward(0.0);
        outward[axis] = is_low ? -1.0 : 1.0;
        if ((params.wall_mask >> border & 1u) != 0 && std::abs(x[axis] - wall) < static_cast<double>(params.spacing) &&
            is_below(settings, outward)) {
            return true;
        }
    }
    return false;
}

bool rests_on_solid(const Settings& settings, const State& state, const glm::dvec3& x)
{
    const double reach = static_cast<double>(shared::RESTING_DISTANCE) * static_cast<double>(settings.params.spacing);
    for (std::size_t j = 0; j < state.size(); ++j) {
        const glm::dvec3 way = state.position[j] - x;
        if (shared::is_still(state.attributes[j]) && !shared::is_gone(state.attributes[j]) &&
            glm::length(way) < reach && is_below(settings, way)) {
            return true;
        }
    }
    return false;
}

} // namespace

void scour(const Settings& settings, const shared::HydraulicParams& hydraulic, const State& state,
           std::span<const glm::dvec4> exposure, Damage damage, double seconds)
{
    for (std::size_t i = 0; i < state.size(); ++i) {
        const std::uint32_t id = state.id[i];
        if (shared::particle_state(state.attributes[i]) != shared::STATE_SOLID ||
            hydraulic.erodes[shared::particle_material(state.attributes[i])] == 0) {
            damage.rate[id] = 0.0;
            continue;
        }
        damage.done[id] += damage.rate[id] * seconds;
        damage.rate[id] =
            exposure[i].w > 0.0 ? damage_rate(settings, hydraulic, state, i, exposure[i], damage.strength[id]) : 0.0;
    }
}

std::size_t deposit(const Settings& settings, const shared::HydraulicParams& hydraulic, State& state,
                    std::span<double> damage, double seconds)
{
    std::vector<std::size_t> deposited;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const std::uint32_t attributes = state.attributes[i];
        if (shared::particle_state(attributes) != shared::STATE_FLUID ||
            shared::cause_of(attributes) != shared::CAUSE_HYDRAULIC ||
            hydraulic.deposits[shared::particle_material(attributes)] == 0) {
            continue;
        }
        const bool is_slow = glm::length(state.velocity[i]) < static_cast<double>(hydraulic.deposition_speed);
        const double rest_density =
            static_cast<double>(settings.params.rest_density[shared::particle_material(attributes)]);
        const bool has_room = state.density[i] < static_cast<double>(shared::MOST_CROWDED) * rest_density;
        const bool rests =
            has_room && is_slow &&
            (rests_on_floor(settings, state.position[i]) || rests_on_solid(settings, state, state.position[i]));
        double& left = damage[state.id[i]];
        left = rests ? left - seconds / static_cast<double>(hydraulic.deposition_time) : 1.0;
        if (left <= 0.0) {
            left = 0.0;
            deposited.push_back(i);
        }
    }
    for (const std::size_t i : deposited) { // those who settle at the same look do not rest on each other
        state.attributes[i] = shared::with_state(state.attributes[i], shared::STATE_SOLID);
        state.velocity[i] = glm::dvec3(0.0);
    }
    return deposited.size();
}

std::size_t detach(const shared::HydraulicParams& hydraulic, State& state, Damage damage, double ahead)
{
    std::size_t freed = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const std::uint32_t id = state.id[i];
        if (shared::particle_state(state.attributes[i]) == shared::STATE_SOLID &&
            hydraulic.erodes[shared::particle_material(state.attributes[i])] != 0 &&
            damage.done[id] + damage.rate[id] * ahead >= 1.0) {
            damage.done[id] = 1.0;
            state.attributes[i] = shared::freed_as(state.attributes[i], shared::STATE_FLUID, shared::CAUSE_HYDRAULIC);
            ++freed;
        }
    }
    return freed;
}

} // namespace meltpoint::reference
