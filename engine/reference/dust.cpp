// Kraichnan, "Diffusion by a Random Velocity Field", Phys. Fluids 13, 1970: a velocity field of random waves.
#include "reference/dust.h"

#include <algorithm>
#include <cmath>

#include "reference/walls.h"

namespace meltpoint::reference {

glm::dvec3 air_velocity(const shared::DustParams& dust, const glm::dvec3& x, double time)
{
    const glm::dvec3 wind(dust.wind);
    const glm::dvec3 carried = x - time * wind;
    glm::dvec3 v = wind;
    for (const shared::AirWave& wave : dust.waves) {
        const double angle = glm::dot(glm::dvec3(wave.number), carried) + static_cast<double>(wave.frequency) * time +
                             static_cast<double>(wave.phase);
        v += std::cos(angle) * glm::dvec3(wave.amplitude);
    }
    return v;
}

void drift_dust(const Settings& settings, const shared::DustParams& dust, State& state,
                std::span<const float> release_time, double time)
{
    const double dt = static_cast<double>(settings.params.dt);
    const double taken_on = 1.0 - std::exp(-dt / static_cast<double>(dust.response_time));
    const glm::dvec3 low(settings.params.domain_min);
    const glm::dvec3 high(settings.params.domain_max);
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (!shared::is_drifting(state.attributes[i])) {
            continue;
        }
        glm::dvec3& v = state.velocity[i];
        v += taken_on * (air_velocity(dust, state.position[i], time) - v);
        const glm::dvec3 x = wrap_position(settings.params, state.position[i] + dt * v);
        const double left =
            1.0 - (time - static_cast<double>(release_time[state.id[i]])) / static_cast<double>(dust.life);
        const bool inside = glm::all(glm::greaterThanEqual(x, low)) && glm::all(glm::lessThanEqual(x, high));
        state.position[i] = inside ? x : state.position[i];
        state.density[i] = std::clamp(left, 0.0, 1.0);
        if (!inside || left <= 0.0) {
            state.attributes[i] = shared::with_state(state.attributes[i], shared::STATE_DEAD);
        }
    }
}

} // namespace meltpoint::reference
