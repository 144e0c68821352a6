// Solenthaler & Pajarola, "Density Contrast SPH Interfaces", SCA 2008 (number density).
// Akinci, Ihmsen, Akinci, Solenthaler & Teschner, "Versatile Rigid-Fluid Coupling for Incompressible SPH", SIGGRAPH
// 2012 (boundary particles). Batchelor, "An Introduction to Fluid Dynamics", 1967; Monaghan, "Simulating Free Surface
// Flows with SPH", 1994 (Tait equation).
#include "reference/density.h"

#include <algorithm>
#include <cmath>

#include "core/parallel_for.h"
#include "particles/sph_kernel.h"
#include "reference/walls.h"

namespace meltpoint::reference {

double density(const Settings& settings, const State& state, const Neighbors& neighbors, std::size_t i)
{
    const double support_radius = static_cast<double>(settings.params.support_radius);
    double number_density = state.weight[i] * density_shape(settings.kernel, 0.0);
    for (const Neighbor& neighbor : neighbors.of(i)) {
        const glm::dvec3 image = reflect_position(settings.params, neighbor.reflection, state.position[neighbor.index]);
        number_density += state.weight[neighbor.index] *
                          density_shape(settings.kernel, glm::length(state.position[i] - image) / support_radius);
    }
    return state.mass[i] * static_cast<double>(settings.params.density_scale) * number_density;
}

double pressure(const shared::SphParams& params, double density, double rest_density)
{
    const double c0 = static_cast<double>(params.speed_of_sound);
    const double gamma = static_cast<double>(params.gamma);
    const double excess = params.state_equation == shared::STATE_EQUATION_LINEAR
                              ? c0 * c0 * (density - rest_density)
                              : c0 * c0 * rest_density / gamma * (std::pow(density / rest_density, gamma) - 1.0);
    const double p = excess + static_cast<double>(params.background_pressure);
    return params.clamp_pressure != 0u ? std::max(p, 0.0) : p;
}

void update_density(const Settings& settings, State& state, const Neighbors& neighbors)
{
    parallel_for(state.size(), [&](std::size_t i) {
        if (is_boundary(state, i)) {
            state.density[i] = state.pressure[i] = 0.0;
            return;
        }
        state.density[i] = density(settings, state, neighbors, i);
        if (settings.solver == shared::SOLVER_WCSPH) {
            state.pressure[i] = pressure(settings.params, state.density[i], rest_density(settings, state, i));
        }
    });
}

} // namespace meltpoint::reference
