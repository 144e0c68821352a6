// Akinci, Ihmsen, Akinci, Solenthaler & Teschner, "Versatile Rigid-Fluid Coupling for Incompressible SPH", SIGGRAPH
// 2012, equations 9 and 13: the forces on the rigid body are those on the fluid, turned around.
#include "reference/boundary_force.h"

#include <cmath>

#include "particles/sph_kernel.h"
#include "reference/walls.h"

namespace meltpoint::reference {

VectorSum push_on_boundary(const Settings& settings, const State& state, const Neighbors& neighbors,
                           const std::vector<double>& pressure_term, std::size_t b)
{
    const double scale = static_cast<double>(settings.params.gradient_scale);
    const double support_radius = static_cast<double>(settings.params.support_radius);
    VectorSum sum;
    for (const Neighbor& neighbor : neighbors.of(b)) {
        const glm::dvec3 offset =
            state.position[b] - reflect_position(settings.params, neighbor.reflection, state.position[neighbor.index]);
        const double r = glm::length(offset);
        if (r < static_cast<double>(shared::COINCIDENT_RATIO) * support_radius) {
            continue;
        }
        const glm::dvec3 descent = scale * gradient_shape(settings.kernel, r / support_radius) / r * offset;
        sum.add(pressure_term[neighbor.index] * state.weight[b] * descent);
    }
    return sum;
}

VectorSum friction_on_boundary(const Settings& settings, const State& state, const Neighbors& neighbors, std::size_t b)
{
    const double support_radius = static_cast<double>(settings.params.support_radius);
    const double volume = state.weight[b] * static_cast<double>(settings.params.lattice_volume);
    const double friction =
        static_cast<double>(settings.params.friction[shared::particle_material(state.attributes[b])]);
    const double factor = friction * volume * static_cast<double>(settings.params.viscosity_scale);
    VectorSum sum;
    for (const Neighbor& neighbor : neighbors.of(b)) {
        const std::size_t j = neighbor.index;
        if (is_boundary(state, j)) {
            continue;
        }
        const double r =
            glm::length(state.position[b] - reflect_position(settings.params, neighbor.reflection, state.position[j]));
        const glm::dvec3 relative = reflect_velocity(neighbor.reflection, state.velocity[j]) - state.velocity[b];
        sum.add(factor * state.mass[j] / state.density[j] * viscosity_shape(settings.kernel, r / support_radius) *
                relative);
    }
    return sum;
}

std::vector<double> pressure_terms(const State& state)
{
    std::vector<double> terms(state.size(), 0.0);
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (!is_boundary(state, i)) {
            terms[i] = state.pressure[i] * std::pow(state.mass[i] / state.density[i], 2);
        }
    }
    return terms;
}

} // namespace meltpoint::reference
