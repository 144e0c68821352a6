// Velocity Verlet, kick-drift-kick (Swope, Andersen, Berens & Wilson 1982).
#include "reference/integrate.h"

#include <algorithm>

#include "core/parallel_for.h"
#include "reference/walls.h"

namespace meltpoint::reference {
namespace {

bool is_finite(const glm::dvec3& v)
{
    return !glm::any(glm::isnan(v)) && !glm::any(glm::isinf(v));
}

bool is_outside(const shared::SphParams& params, const glm::dvec3& position)
{
    return glm::any(glm::lessThan(position, glm::dvec3(params.domain_min))) ||
           glm::any(glm::greaterThan(position, glm::dvec3(params.domain_max)));
}

std::uint32_t fault_of(const shared::SphParams& params, const glm::dvec3& position, const glm::dvec3& velocity)
{
    if (!is_finite(position) || !is_finite(velocity)) {
        return shared::FAULT_NOT_FINITE;
    }
    if (glm::length(velocity) > static_cast<double>(params.speed_limit)) {
        return shared::FAULT_TOO_FAST;
    }
    return is_outside(params, position) ? shared::FAULT_ESCAPED : shared::FAULT_NONE;
}

} // namespace

void kick(State& state, double t)
{
    parallel_for(state.size(), [&](std::size_t i) { state.velocity[i] += state.acceleration[i] * t; });
}

glm::dvec3 held_off_walls(const shared::SphParams& params, const glm::dvec3& position, glm::dvec3 velocity,
                          double seconds)
{
    const double reach = static_cast<double>(params.contact_distance);
    for_each_wall(params, position, [&](double distance, const glm::dvec3& normal) {
        const double slowest = std::min((reach - distance) / seconds, 0.0);
        velocity += std::max(slowest - glm::dot(velocity, normal), 0.0) * normal;
    });
    return velocity;
}

void hold_off_walls(const Settings& settings, State& state)
{
    const double dt = static_cast<double>(settings.params.dt);
    parallel_for(state.size(), [&](std::size_t i) {
        if (!is_boundary(state, i)) {
            state.velocity[i] = held_off_walls(settings.params, state.position[i], state.velocity[i], dt);
        }
    });
}

void drift(const Settings& settings, State& state)
{
    const double dt = static_cast<double>(settings.params.dt);
    parallel_for(state.size(), [&](std::size_t i) {
        if (!is_boundary(state, i)) {
            state.position[i] = wrap_position(settings.params, state.position[i] + state.velocity[i] * dt);
        }
    });
    watch(settings, state);
}

void watch(const Settings& settings, State& state)
{
    std::vector<std::uint32_t> fault(state.size(), shared::FAULT_NONE);
    parallel_for(state.size(), [&](std::size_t i) {
        if (is_boundary(state, i)) {
            return;
        }
        if (is_outside(settings.params, state.position[i])) {
            state.attributes[i] |= shared::FLAG_LEFT_DOMAIN;
        }
        fault[i] = fault_of(settings.params, state.position[i], state.velocity[i]);
    });

    if (state.status.fault != shared::FAULT_NONE) {
        return;
    }
    for (std::size_t i = 0; i < state.size(); ++i) {
        const bool first = state.status.fault == shared::FAULT_NONE || state.id[i] < state.status.particle;
        if (fault[i] != shared::FAULT_NONE && first) {
            state.status.fault = fault[i];
            state.status.step = state.step;
            state.status.particle = state.id[i];
        }
    }
}

} // namespace meltpoint::reference
