// Lind, Xu, Stansby & Rogers, "Incompressible smoothed particle hydrodynamics for free-surface flows: A generalised
// diffusion-based algorithm for stability and validations", J. Comput. Phys. 231, 2012.
#include "reference/shifting.h"

#include <cmath>

#include "core/parallel_for.h"
#include "particles/sph_kernel.h"
#include "reference/walls.h"

namespace meltpoint::reference {

VectorSum wanted_shift(const Settings& settings, const State& state, const Neighbors& neighbors, std::size_t i)
{
    const shared::SphParams& params = settings.params;
    const double support_radius = static_cast<double>(params.support_radius);
    const double reach = static_cast<double>(params.shifting) * static_cast<double>(params.dt);
    VectorSum sum;
    for (const Neighbor& neighbor : neighbors.of(i)) {
        const std::size_t j = neighbor.index;
        const glm::dvec3 offset = state.position[i] - reflect_position(params, neighbor.reflection, state.position[j]);
        const double r = glm::length(offset);
        const double q = r / support_radius;
        if (q < static_cast<double>(shared::COINCIDENT_RATIO)) {
            continue;
        }
        const double volume = is_boundary(state, j) ? state.weight[j] * static_cast<double>(params.lattice_volume)
                                                    : state.mass[j] / state.density[j];
        const double near = static_cast<double>(params.shifting_scale) * density_shape(settings.kernel, q);
        const double slope = static_cast<double>(params.gradient_scale) * gradient_shape(settings.kernel, q);
        sum.add(reach * volume * (1.0 + static_cast<double>(shared::SHIFT_NEAR) * std::pow(near, 4.0)) * slope / r *
                offset);
    }
    return sum;
}

glm::dvec3 shift(const Settings& settings, const State& state, const Neighbors& neighbors, std::size_t i)
{
    const glm::dvec3 wanted = wanted_shift(settings, state, neighbors, i).value;
    const double longest = static_cast<double>(shared::SHIFT_CAP) * static_cast<double>(settings.params.spacing);
    const double distance = glm::length(wanted);
    return distance > longest ? longest / distance * wanted : wanted;
}

void shift_particles(const Settings& settings, State& state, const Neighbors& neighbors)
{
    if (!(settings.params.shifting > 0.0f)) {
        return;
    }
    std::vector<glm::dvec3> shifted = state.position;
    parallel_for(state.size(), [&](std::size_t i) {
        if (!is_boundary(state, i)) {
            shifted[i] = wrap_position(settings.params, state.position[i] + shift(settings, state, neighbors, i));
        }
    });
    state.position = shifted;
}

} // namespace meltpoint::reference
