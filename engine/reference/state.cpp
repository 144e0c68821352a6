#include "reference/state.h"

namespace meltpoint::reference {

State from_particle_set(const ParticleSet& particles)
{
    State state;
    state.id = particles.id;
    state.attributes = particles.attributes;
    state.position.assign(particles.position.begin(), particles.position.end());
    state.velocity.assign(particles.velocity.begin(), particles.velocity.end());
    state.acceleration.assign(particles.acceleration.begin(), particles.acceleration.end());
    state.mass.assign(particles.mass.begin(), particles.mass.end());
    state.weight.assign(particles.weight.begin(), particles.weight.end());
    state.density.assign(particles.density.begin(), particles.density.end());
    state.pressure.assign(particles.pressure.begin(), particles.pressure.end());
    return state;
}

ParticleSet to_particle_set(const State& state)
{
    ParticleSet particles;
    particles.resize(state.size());
    particles.id = state.id;
    particles.attributes = state.attributes;
    for (std::size_t i = 0; i < state.size(); ++i) {
        particles.position[i] = glm::vec3(state.position[i]);
        particles.velocity[i] = glm::vec3(state.velocity[i]);
        particles.acceleration[i] = glm::vec3(state.acceleration[i]);
        particles.mass[i] = static_cast<float>(state.mass[i]);
        particles.weight[i] = static_cast<float>(state.weight[i]);
        particles.density[i] = static_cast<float>(state.density[i]);
        particles.pressure[i] = static_cast<float>(state.pressure[i]);
    }
    return particles;
}

} // namespace meltpoint::reference
