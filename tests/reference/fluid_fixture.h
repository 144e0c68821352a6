#pragma once

#include <cstddef>
#include <cstdint>

#include "core/random.h"
#include "particles/sph_kernel.h"
#include "reference/state.h"

namespace meltpoint::reference {

/// Water in a box of 1 m with no walls and no gravity, c0 = 10 m/s, linear state equation, dt at 0.4 of the CFL bound.
inline Settings make_settings(std::uint32_t kernel, double spacing, double support_ratio)
{
    Settings settings;
    settings.kernel = kernel;
    shared::SphParams& p = settings.params;
    p.domain_min = glm::vec3(0.0f);
    p.domain_max = glm::vec3(1.0f);
    p.support_radius = static_cast<float>(spacing * support_ratio);
    p.speed_of_sound = 10.0f;
    p.dt = 0.2f * p.support_radius / (1.1f * p.speed_of_sound);
    p.gamma = 7.0f;
    p.clamp_pressure = 1;
    p.tension_threshold = 0.5f;
    p.speed_limit = p.speed_of_sound;
    for (float& density : p.rest_density) {
        density = 1000.0f;
    }
    set_kernel_scales(p, kernel, spacing);
    return settings;
}

/// Adds a particle of fluid at rest with mass and density of that spacing.
inline void add_particle(State& state, const glm::dvec3& position, double spacing,
                         const glm::dvec3& velocity = glm::dvec3(0.0))
{
    state.id.push_back(static_cast<std::uint32_t>(state.size()));
    state.attributes.push_back(shared::pack_attributes(shared::STATE_FLUID, 0));
    state.position.push_back(position);
    state.velocity.push_back(velocity);
    state.acceleration.emplace_back(0.0);
    state.mass.push_back(1000.0 * spacing * spacing * spacing);
    state.weight.push_back(1.0);
    state.density.push_back(1000.0);
    state.pressure.push_back(0.0);
}

/// Adds a boundary particle of material 1.
inline void add_boundary_particle(State& state, const glm::dvec3& position)
{
    add_particle(state, position, 0.0);
    state.attributes.back() = shared::pack_attributes(shared::STATE_COLLIDER, 1);
    state.density.back() = 0.0;
}

/// Adds count.x * count.y * count.z particles of a cubic lattice, the first at `first`.
inline void add_lattice(State& state, const glm::dvec3& first, const glm::ivec3& count, double spacing)
{
    for (int z = 0; z < count.z; ++z) {
        for (int y = 0; y < count.y; ++y) {
            for (int x = 0; x < count.x; ++x) {
                add_particle(state, first + spacing * glm::dvec3(x, y, z), spacing);
            }
        }
    }
}

/// Uniform in [-1, 1]^3.
inline glm::dvec3 random_vector(Random& random)
{
    const double x = random.uniform();
    const double y = random.uniform();
    const double z = random.uniform();
    return 2.0 * glm::dvec3(x, y, z) - 1.0;
}

/// Adds fluid of two masses that moves at random, 6^3 particles on a lattice that is `pressed` times as wide as their
/// spacing, moved by up to `jitter` spacings, above a plate of boundary particles.
inline void add_mixture_on_plate(State& state, const glm::dvec3& first, double spacing, double pressed, double jitter)
{
    for (int i = 0; i < 216; ++i) {
        add_particle(state, first + pressed * spacing * glm::dvec3(i % 6, i / 6 % 6, i / 36), spacing);
    }
    Random random(4);
    for (std::size_t i = 0; i < state.size(); ++i) {
        state.position[i] += jitter * spacing * random_vector(random);
        state.velocity[i] = random_vector(random);
        state.mass[i] *= i % 3 == 0 ? 0.6 : 1.0;
    }
    for (int i = 0; i < 36; ++i) {
        add_boundary_particle(state, first + spacing * glm::dvec3(i % 6, -0.8, i / 6));
    }
}

} // namespace meltpoint::reference
