#include "bench/block.h"

#include <cmath>

#include <fmt/format.h>

#include "core/random.h"

namespace meltpoint::bench {

namespace {

constexpr double support_ratio = 2.05;
constexpr double jitter = 0.05; // of the spacing

/// Particles along an edge of the block.
std::uint32_t edge(std::uint32_t particles)
{
    auto n = static_cast<std::uint32_t>(std::cbrt(static_cast<double>(particles)));
    while (std::uint64_t{n} * n * n < particles) {
        ++n;
    }
    return n;
}

} // namespace

Scene block_scene(std::uint32_t particles)
{
    Scene scene;
    scene.name = fmt::format("block of {} particles", particles);
    scene.particles.spacing = 1.0f / static_cast<float>(edge(particles));
    scene.particles.support_ratio = static_cast<float>(support_ratio);
    scene.domain.min = glm::vec3(0.0f);
    scene.domain.max = glm::vec3(3.0f, 1.5f, 1.0f);
    scene.fluids.push_back({BlockShape{glm::vec3(0.0f), glm::vec3(1.0f)}});
    return scene;
}

ParticleSet block_particles(std::uint32_t particles, std::uint64_t seed)
{
    const Scene scene = block_scene(particles);
    const std::uint32_t n = edge(particles);
    const double spacing = 1.0 / n;
    ParticleSet set;
    set.resize(particles);
    for (std::uint32_t i = 0; i < particles; ++i) {
        Random random(seed, i);
        const glm::dvec3 place(i % n, i / (n * n), i / n % n);
        glm::dvec3 offset(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            offset[axis] = jitter * (2.0 * random.uniform() - 1.0);
        }
        set.position[i] = glm::vec3((place + 0.5 + offset) * spacing);
        set.mass[i] = static_cast<float>(static_cast<double>(scene.fluids[0].rest_density) * std::pow(spacing, 3));
    }
    return set;
}

} // namespace meltpoint::bench
