#include "reference/step.h"

#include "core/parallel_for.h"
#include "reference/boundary.h"
#include "reference/capillarity.h"
#include "reference/cells.h"
#include "reference/density.h"
#include "reference/forces.h"
#include "reference/integrate.h"
#include "reference/shifting.h"
#include "reference/viscosity.h"
#include "reference/vorticity.h"

namespace meltpoint::reference {

namespace {

void update(const Settings& settings, State& state, bool smooth)
{
    const Neighbors neighbors = find_neighbors(settings.params, state.position);
    update_boundary_weights(settings, state, neighbors);
    update_density(settings, state, neighbors);
    if (smooth) {
        smooth_velocities(settings, state, neighbors);
    }
    const Accelerations a = accelerations(settings, state, neighbors);
    parallel_for(state.size(), [&](std::size_t i) { state.acceleration[i] = a.total[i].value; });
    add_confinement(settings, state, neighbors);
    add_capillarity(settings, state, neighbors);
    state.status.coincident = a.coincident_pairs;
}

} // namespace

void evaluate(const Settings& settings, State& state)
{
    update(settings, state, false);
}

void step(const Settings& settings, State& state)
{
    const double half_step = 0.5 * static_cast<double>(settings.params.dt);
    kick(state, half_step);
    drift(settings, state);
    update(settings, state, true);
    kick(state, half_step);
    if (settings.implicit_viscosity) {
        (void)solve_viscosity(settings, state, find_neighbors(settings.params, state.position));
    }
    if (settings.params.shifting > 0.0f) {
        shift_particles(settings, state, find_neighbors(settings.params, state.position));
    }
    ++state.step;
}

} // namespace meltpoint::reference
