// Akinci, Ihmsen, Akinci, Solenthaler & Teschner, "Versatile Rigid-Fluid Coupling for Incompressible SPH", SIGGRAPH
// 2012.
#include "reference/boundary.h"

#include <cmath>

#include "core/parallel_for.h"
#include "particles/sph_kernel.h"
#include "reference/walls.h"

namespace meltpoint::reference {

namespace {

bool is_collider(const State& state, std::size_t i)
{
    return shared::particle_state(state.attributes[i]) == shared::STATE_COLLIDER;
}

} // namespace

double boundary_weight(const Settings& settings, const State& state, const Neighbors& neighbors, std::size_t b)
{
    const double support_radius = static_cast<double>(settings.params.support_radius);
    double sum = density_shape(settings.kernel, 0.0);
    for (const Neighbor& neighbor : neighbors.of(b)) {
        if (is_collider(state, neighbor.index)) {
            const glm::dvec3 image =
                reflect_position(settings.params, neighbor.reflection, state.position[neighbor.index]);
            sum += density_shape(settings.kernel, glm::length(state.position[b] - image) / support_radius);
        }
    }
    const double volume = 1.0 / (static_cast<double>(settings.params.density_scale) * sum);
    return volume / static_cast<double>(settings.params.lattice_volume);
}

void update_boundary_weights(const Settings& settings, State& state, const Neighbors& neighbors)
{
    parallel_for(state.size(), [&](std::size_t i) {
        if (is_collider(state, i)) {
            state.weight[i] = boundary_weight(settings, state, neighbors, i);
        }
    });
}

} // namespace meltpoint::reference
