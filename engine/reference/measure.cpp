#include "reference/measure.h"

#include <algorithm>

namespace meltpoint::reference {

double total_mass(const State& state)
{
    double sum = 0.0;
    for (const double mass : state.mass) {
        sum += mass;
    }
    return sum;
}

double kinetic_energy(const State& state)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        sum += 0.5 * state.mass[i] * glm::dot(state.velocity[i], state.velocity[i]);
    }
    return sum;
}

glm::dvec3 momentum(const State& state)
{
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < state.size(); ++i) {
        sum += state.mass[i] * state.velocity[i];
    }
    return sum;
}

double momentum_magnitude(const State& state)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        sum += state.mass[i] * glm::length(state.velocity[i]);
    }
    return sum;
}

glm::dvec3 center_of_mass(const State& state)
{
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < state.size(); ++i) {
        sum += state.mass[i] * state.position[i];
    }
    return sum / total_mass(state);
}

double max_speed(const State& state)
{
    double speed = 0.0;
    for (const glm::dvec3& velocity : state.velocity) {
        speed = std::max(speed, glm::length(velocity));
    }
    return speed;
}

double potential_energy(const Settings& settings, const State& state)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        sum -= state.mass[i] * glm::dot(glm::dvec3(settings.params.gravity), state.position[i]);
    }
    return sum;
}

} // namespace meltpoint::reference
