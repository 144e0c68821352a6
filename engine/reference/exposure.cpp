#include "reference/exposure.h"

#include <algorithm>

#include "core/parallel_for.h"
#include "particles/sph_kernel.h"
#include "reference/cells.h"
#include "shared/exposure.h"

namespace meltpoint::reference {

namespace {

bool is_solid(const State& state, std::size_t i)
{
    return shared::particle_state(state.attributes[i]) == shared::STATE_SOLID;
}

bool counts(const State& state, std::size_t j)
{
    return is_solid(state, j) || shared::particle_state(state.attributes[j]) == shared::STATE_COLLIDER;
}

/// Of the face of a lattice cell, m^2.
double cell_face(const shared::SphParams& params)
{
    return static_cast<double>(params.lattice_volume) / static_cast<double>(params.spacing);
}

} // namespace

std::vector<glm::dvec4> exposure_of_all(const Settings& settings, const State& state)
{
    shared::SphParams params = settings.params;
    params.support_radius = shared::EXPOSURE_SUPPORT * params.spacing;
    const double support_radius = static_cast<double>(params.support_radius);
    const double filling_scale = solid_filling_scale(settings.dimensions);
    const double scale = exposed_area_scale(settings.dimensions) * cell_face(params);
    const Neighbors neighbors = find_neighbors(params, state.position);
    std::vector<glm::dvec4> exposed(state.size(), glm::dvec4(0.0));
    parallel_for(state.size(), [&](std::size_t i) {
        glm::dvec3 sum(0.0);
        double filling = state.weight[i] * density_shape(shared::KERNEL_WENDLAND, 0.0);
        for (const Neighbor& neighbor : neighbors.of(i)) {
            const glm::dvec3 offset =
                state.position[i] - reflect_position(params, neighbor.reflection, state.position[neighbor.index]);
            const double r = glm::length(offset);
            if (is_solid(state, i) && counts(state, neighbor.index)) {
                filling += state.weight[neighbor.index] * density_shape(shared::KERNEL_WENDLAND, r / support_radius);
            }
            if (is_solid(state, i) && counts(state, neighbor.index) && r > 0.0) {
                sum += state.weight[neighbor.index] * gradient_shape(shared::KERNEL_WENDLAND, r / support_radius) *
                       offset / r;
            }
        }
        if (is_solid(state, i)) {
            const double size = glm::length(sum);
            const double lacking = 1.0 - filling_scale * filling / static_cast<double>(shared::THIN_FILLING);
            const double thin = 2.0 * settings.dimensions * std::max(lacking, 0.0) * cell_face(params);
            exposed[i] =
                glm::dvec4(size > 0.0 ? sum / size : glm::dvec3(0.0), state.weight[i] * std::max(scale * size, thin));
        }
    });
    return exposed;
}

std::vector<glm::dvec4> exposure(const Settings& settings, const State& state)
{
    std::vector<glm::dvec4> exposed = exposure_of_all(settings, state);
    for (std::size_t i = 0; i < exposed.size(); ++i) {
        const double least = static_cast<double>(shared::LEAST_EXPOSURE) * state.weight[i] * cell_face(settings.params);
        exposed[i] = exposed[i].w < least ? glm::dvec4(0.0) : exposed[i];
    }
    return exposed;
}

} // namespace meltpoint::reference
