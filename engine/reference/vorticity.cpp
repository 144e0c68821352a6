// Monaghan, "On the problem of penetration in particle methods", J. Comput. Phys. 82, 1989; Schechter & Bridson, "Ghost
// SPH for Animating Water", ACM Trans. Graph. 31(4), 2012 (XSPH). Macklin & Müller, "Position Based Fluids", ACM Trans.
// Graph. 32(4), 2013; Fedkiw, Stam & Jensen, "Visual Simulation of Smoke", SIGGRAPH 2001 (vorticity confinement).
#include "reference/vorticity.h"

#include "core/parallel_for.h"
#include "particles/sph_kernel.h"
#include "reference/walls.h"

namespace meltpoint::reference {
namespace {

/// A pair as particle i sees it.
struct Pair {
    double q;            // r/H
    glm::dvec3 g;        // -grad W_ij, 1/m^4; zero for coincident particles
    glm::dvec3 velocity; // of j, or its image
    double volume;       // of fluid j, m^3; 0 of a boundary particle
};

Pair make_pair(const Settings& settings, const State& state, std::size_t i, const Neighbor& neighbor)
{
    const std::size_t j = neighbor.index;
    const glm::dvec3 offset =
        state.position[i] - reflect_position(settings.params, neighbor.reflection, state.position[j]);
    const double r = glm::length(offset);
    const double q = r / static_cast<double>(settings.params.support_radius);
    const bool coincident = q < static_cast<double>(shared::COINCIDENT_RATIO);
    const double slope = static_cast<double>(settings.params.gradient_scale) * gradient_shape(settings.kernel, q);
    return {.q = q,
            .g = coincident ? glm::dvec3(0.0) : slope / r * offset,
            .velocity = reflect_velocity(neighbor.reflection, state.velocity[j]),
            .volume = is_boundary(state, j) ? 0.0 : state.mass[j] / state.density[j]};
}

} // namespace

VectorSum smoothing(const Settings& settings, const State& state, const Neighbors& neighbors, std::size_t i)
{
    const double factor =
        2.0 * static_cast<double>(settings.params.xsph) * static_cast<double>(settings.params.density_scale);
    VectorSum sum;
    for (const Neighbor& neighbor : neighbors.of(i)) {
        const std::size_t j = neighbor.index;
        if (!is_boundary(state, j)) {
            const Pair pair = make_pair(settings, state, i, neighbor);
            const double share = state.mass[j] / (state.density[i] + state.density[j]);
            sum.add(factor * share * density_shape(settings.kernel, pair.q) * (pair.velocity - state.velocity[i]));
        }
    }
    return sum;
}

VectorSum vorticity(const Settings& settings, const State& state, const Neighbors& neighbors, std::size_t i)
{
    VectorSum sum;
    for (const Neighbor& neighbor : neighbors.of(i)) {
        const Pair pair = make_pair(settings, state, i, neighbor);
        sum.add(pair.volume * glm::cross(pair.velocity - state.velocity[i], pair.g));
    }
    return sum;
}

glm::dvec3 confinement(const Settings& settings, const State& state, const Neighbors& neighbors,
                       const std::vector<glm::dvec3>& vorticities, std::size_t i)
{
    const double own = glm::length(vorticities[i]);
    glm::dvec3 rise(0.0);
    for (const Neighbor& neighbor : neighbors.of(i)) {
        const Pair pair = make_pair(settings, state, i, neighbor);
        rise -= pair.volume * (glm::length(vorticities[neighbor.index]) - own) * pair.g;
    }
    const double support_radius = static_cast<double>(settings.params.support_radius);
    const double length = glm::length(rise) + static_cast<double>(shared::FLAT_VORTICITY) * own / support_radius;
    const glm::dvec3 direction = length > 0.0 ? rise / length : glm::dvec3(0.0);
    return static_cast<double>(settings.params.vorticity_confinement) * glm::cross(direction, vorticities[i]);
}

void smooth_velocities(const Settings& settings, State& state, const Neighbors& neighbors)
{
    if (!(settings.params.xsph > 0.0f)) {
        return;
    }
    std::vector<glm::dvec3> smoothed = state.velocity;
    parallel_for(state.size(), [&](std::size_t i) {
        if (!is_boundary(state, i)) {
            smoothed[i] += smoothing(settings, state, neighbors, i).value;
        }
    });
    state.velocity = smoothed;
}

void add_confinement(const Settings& settings, State& state, const Neighbors& neighbors)
{
    if (!(settings.params.vorticity_confinement > 0.0f)) {
        return;
    }
    std::vector<glm::dvec3> vorticities(state.size(), glm::dvec3(0.0));
    parallel_for(state.size(), [&](std::size_t i) {
        if (!is_boundary(state, i)) {
            vorticities[i] = vorticity(settings, state, neighbors, i).value;
        }
    });
    parallel_for(state.size(), [&](std::size_t i) {
        if (!is_boundary(state, i)) {
            state.acceleration[i] += confinement(settings, state, neighbors, vorticities, i);
        }
    });
}

} // namespace meltpoint::reference
