#pragma once

#include <cmath>
#include <functional>
#include <string>

#include <glm/glm.hpp>

#include "core/random.h"
#include "particles/particle_set.h"
#include "particles/sph_kernel.h"
#include "sim/simulation.h"

namespace meltpoint {

/// A unit box with walls, spacing 0.05 m: what the conformance tests run in unless they say otherwise.
inline constexpr float test_spacing = 0.05f;
inline constexpr float test_rest_density = 1000.0f;

inline sim::SimulationSettings test_settings(std::uint32_t kernel)
{
    sim::SimulationSettings settings;
    settings.options.kernel = kernel;
    shared::SphParams& params = settings.params;
    params.domain_min = glm::vec3(0.0f);
    params.domain_max = glm::vec3(1.0f);
    params.support_radius = (kernel == shared::KERNEL_PAPER ? 2.0f : 3.0f) * test_spacing;
    params.gravity = glm::vec3(0.0f, -9.81f, 0.0f);
    params.wall_mask = 0x3f;
    params.state_equation = shared::STATE_EQUATION_TAIT;
    params.clamp_pressure = 1;
    params.speed_of_sound = 40.0f;
    params.gamma = 7.0f;
    set_viscosity(params, 1.0f);
    params.friction[1] = 2.0f;
    params.density_error = 1e-3f;
    params.divergence_error = 1e-3f;
    params.max_iterations = 40;
    params.viscosity_error = 1e-3f;
    params.viscosity_iterations = 40;
    params.least_iterations = 1;
    params.artificial_pressure = 0.01f;
    params.speed_cap = 0.5f * test_spacing;
    params.dt = 2e-4f;
    params.speed_limit = 1000.0f;
    for (float& density : params.rest_density) {
        density = test_rest_density;
    }
    set_kernel_scales(params, kernel, static_cast<double>(test_spacing));
    params.constraint_softness =
        0.01f * static_cast<float>(lattice_response(kernel, static_cast<double>(params.support_radius),
                                                    static_cast<double>(test_spacing)));
    return settings;
}

/// Tension that moves fluid as fast as gravity does, on floors that it wets and colliders that it does not.
inline sim::SimulationSettings with_tension(sim::SimulationSettings settings)
{
    settings.options.capillarity = settings.options.colliders = true;
    settings.params.tension[0] = 10.0f * test_rest_density * test_spacing * test_spacing;
    settings.params.contact_cosine[1] = -0.4f;
    settings.params.wall_contact_cosine = 0.3f;
    return settings;
}

/// By value: the position may be one of the set's own, which resizing moves.
inline void add_particle(ParticleSet& set, glm::vec3 position, glm::vec3 velocity = glm::vec3(0.0f))
{
    const std::size_t i = set.size();
    set.resize(i + 1);
    set.position[i] = position;
    set.velocity[i] = velocity;
    set.mass[i] = test_rest_density * test_spacing * test_spacing * test_spacing;
}

inline glm::vec3 random_vector(Random& random)
{
    return {static_cast<float>(random.uniform()), static_cast<float>(random.uniform()),
            static_cast<float>(random.uniform())};
}

/// A boundary particle of material 1.
inline void add_boundary_particle(ParticleSet& set, const glm::vec3& position)
{
    add_particle(set, position);
    set.attributes.back() = shared::pack_attributes(shared::STATE_COLLIDER, 1);
    set.mass.back() = 0.0f;
    set.weight.back() = 0.0f; // not known yet
}

/// A plate one boundary particle thick across a box `width` (m) wide and deep, `spacing` between its particles, each
/// moved by up to `jitter` spacings along it.
inline void add_plate(ParticleSet& set, float width, float height, float spacing, float jitter, std::uint64_t seed)
{
    Random random(seed);
    const auto count = static_cast<int>(std::ceil(width / spacing));
    for (int z = 0; z < count; ++z) {
        for (int x = 0; x < count; ++x) {
            const glm::vec3 cell(static_cast<float>(x) + 0.5f, 0.0f, static_cast<float>(z) + 0.5f);
            const glm::vec3 shift = jitter * (2.0f * random_vector(random) - 1.0f) * glm::vec3(1.0f, 0.0f, 1.0f);
            add_boundary_particle(set,
                                  glm::clamp(spacing * (cell + shift), glm::vec3(0.0f), glm::vec3(width, 0.0f, width)) +
                                      glm::vec3(0.0f, height, 0.0f));
        }
    }
}

/// A cubic lattice block of size.x * size.y * size.z particles whose first particle's center is `corner`.
inline ParticleSet lattice_state(const glm::uvec3& size, const glm::vec3& corner)
{
    ParticleSet set;
    for (std::uint32_t z = 0; z < size.z; ++z) {
        for (std::uint32_t y = 0; y < size.y; ++y) {
            for (std::uint32_t x = 0; x < size.x; ++x) {
                add_particle(set, corner + test_spacing * glm::vec3(x, y, z));
            }
        }
    }
    return set;
}

/// `count` particles anywhere in the part [low, high] of the unit box, with velocities up to 1 m/s along each axis.
inline ParticleSet random_state(std::size_t count, const glm::vec3& low, const glm::vec3& high, std::uint64_t seed)
{
    Random random(seed);
    ParticleSet set;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 position = glm::mix(low, high, random_vector(random));
        add_particle(set, position, 2.0f * random_vector(random) - 1.0f);
    }
    return set;
}

/// A row of far apart particles in the row of cells above one that is crowded: consecutive in the sorted order, they
/// have hundreds of candidates between them.
inline ParticleSet spray_above_a_floor()
{
    ParticleSet set;
    for (std::uint32_t i = 0; i < 40 * 2 * 6; ++i) {
        add_particle(set, 0.5f * test_spacing * (glm::vec3(i % 40, i / 40 % 2, i / 80) + glm::vec3(0.5f, 3.5f, 0.5f)));
    }
    Random random(5);
    for (std::uint32_t i = 0; i < 12; ++i) {
        add_particle(set,
                     glm::vec3(0.04f + 0.08f * static_cast<float>(i), 0.16f, 0.06f) + 0.02f * random_vector(random),
                     random_vector(random));
    }
    return set;
}

/// Four particles at the ends of two rows of cells (of the paper's kernels), and above these a crowded row: a tile that
/// becomes wide halfway through its walk, when its particles have met each other already.
inline ParticleSet wide_halfway()
{
    ParticleSet set;
    add_particle(set, glm::vec3(0.9f, 0.17f, 0.15f), glm::vec3(0.5f, 0.0f, 0.0f));
    add_particle(set, glm::vec3(0.1f, 0.23f, 0.15f), glm::vec3(-0.5f, 0.0f, 0.0f));
    add_particle(set, glm::vec3(0.5f, 0.23f, 0.15f), glm::vec3(0.0f, 0.5f, 0.0f));
    add_particle(set, glm::vec3(0.91f, 0.23f, 0.15f), glm::vec3(0.0f, 0.0f, 0.5f));
    for (std::uint32_t i = 0; i < 40 * 2 * 3; ++i) {
        add_particle(set, 0.5f * test_spacing * (glm::vec3(i % 40, i / 40 % 2, i / 80) + glm::vec3(0.5f, 12.5f, 4.5f)));
    }
    return set;
}

/// A drop that has just hit the floor, with spray above: dense, sparse and lone particles at once.
inline ParticleSet splash_state(std::uint64_t seed)
{
    Random random(seed);
    ParticleSet set = lattice_state({12, 4, 11}, glm::vec3(0.2f, 0.5f * test_spacing, 0.21f));
    for (std::size_t i = 0; i < set.size(); ++i) {
        set.position[i] += 0.3f * test_spacing * (random_vector(random) - 0.5f);
        set.velocity[i] = 2.0f * (set.position[i] - glm::vec3(0.5f, 0.0f, 0.5f)) + random_vector(random) - 0.5f;
    }
    for (int i = 0; i < 301; ++i) {
        add_particle(set, glm::mix(glm::vec3(0.01f), glm::vec3(0.99f), random_vector(random)),
                     4.0f * random_vector(random) - 2.0f);
    }
    return set;
}

/// Settings of a box become those of its square at z = 0.
inline void lay_flat(sim::SimulationSettings& settings)
{
    settings.options.dimensions = 2;
    shared::SphParams& params = settings.params;
    params.domain_min.z = -0.5f * params.support_radius;
    params.domain_max.z = 0.5f * params.support_radius;
    params.wall_mask = 0x0f;
    set_kernel_scales(params, settings.options.kernel, static_cast<double>(test_spacing), 2);
}

/// A unit square with walls, for particles at z = 0.
inline sim::SimulationSettings plane_settings(std::uint32_t kernel)
{
    sim::SimulationSettings settings = test_settings(kernel);
    lay_flat(settings);
    shared::SphParams& params = settings.params;
    params.constraint_softness =
        0.01f * static_cast<float>(lattice_response(kernel, static_cast<double>(params.support_radius),
                                                    static_cast<double>(test_spacing), 2));
    return settings;
}

/// The same particles at z = 0 and moving in the plane, with masses of a plane.
inline ParticleSet in_plane(ParticleSet set)
{
    for (std::size_t i = 0; i < set.size(); ++i) {
        set.position[i].z = set.velocity[i].z = 0.0f;
        set.mass[i] /= test_spacing;
    }
    return set;
}

/// A square lattice block of size.x * size.y particles whose first particle's center is `corner`.
inline ParticleSet square_state(const glm::uvec2& size, const glm::vec2& corner)
{
    return in_plane(lattice_state({size, 1u}, glm::vec3(corner, 0.0f)));
}

/// Fluid that moves at random over a dent line of boundary particles, with spray above, in the unit square.
inline ParticleSet plane_splash(std::uint64_t seed)
{
    Random random(seed);
    ParticleSet set = lattice_state({20, 7, 1}, glm::vec3(0.5f * test_spacing, 0.16f, 0.0f));
    for (std::size_t i = 0; i < set.size(); ++i) {
        set.position[i] += 0.3f * test_spacing * (random_vector(random) - 0.5f);
        set.velocity[i] = 2.0f * random_vector(random) - 1.0f;
    }
    for (int i = 0; i < 61; ++i) {
        add_particle(set, glm::mix(glm::vec3(0.01f), glm::vec3(0.99f), random_vector(random)),
                     4.0f * random_vector(random) - 2.0f);
    }
    for (int i = 0; i < 27; ++i) {
        const float x = 0.75f * test_spacing * (static_cast<float>(i) + 0.3f * static_cast<float>(random.uniform()));
        add_boundary_particle(set, glm::vec3(x, 0.13f, 0.0f));
    }
    return in_plane(set);
}

/// Fluid all over the unit box, some of which leaves it in the next step, and a plate of boundary particles from border
/// to border.
inline ParticleSet flow_across_borders(std::uint64_t seed)
{
    Random random(seed);
    ParticleSet set = random_state(900, glm::vec3(0.001f), glm::vec3(0.999f), seed);
    for (std::size_t i = 0; i < 60; ++i) {
        const int axis = static_cast<int>(i % 3);
        const bool at_max = i % 2 == 0;
        set.position[i][axis] = at_max ? 0.99999f : 0.00001f;
        set.velocity[i][axis] = at_max ? 2.0f : -2.0f;
    }
    for (int z = 0; z < 14; ++z) {
        for (int x = 0; x < 14; ++x) {
            const glm::vec3 place(static_cast<float>(x) + 0.5f, 7.0f, static_cast<float>(z) + 0.5f);
            add_boundary_particle(set, place / 14.0f);
        }
    }
    return set;
}

/// s of motion from the look at solids to the next, in steps of one length, when the first of these has just been done.
inline double seconds_between_looks(const sim::Simulation& simulation)
{
    return (1 + simulation.steps_until_erosion()) * static_cast<double>(simulation.params().dt);
}

struct NamedState {
    std::string name;
    std::function<ParticleSet()> make;
};

} // namespace meltpoint
