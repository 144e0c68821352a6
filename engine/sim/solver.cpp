#include "sim/solver.h"

#include "sim/dfsph.h"
#include "sim/pbf.h"
#include "sim/wcsph.h"

namespace meltpoint::sim {

void record_reactions(gpu::Commands& commands, const Fluid& fluid, bool after_viscosity)
{
    if (after_viscosity != (fluid.viscosity != nullptr)) {
        return;
    }
    for (BoundaryForces* forces : {fluid.boundary_forces, fluid.forces_on_loose}) {
        if (forces != nullptr) {
            forces->record_forces(commands, fluid);
        }
    }
}

void record_reaction_impulses(gpu::Commands& commands, const Fluid& fluid, const gpu::Buffer& warm_start)
{
    for (BoundaryForces* forces : {fluid.boundary_forces, fluid.forces_on_loose}) {
        if (forces != nullptr) {
            forces->record_impulses(commands, fluid, warm_start);
        }
    }
}

std::unique_ptr<Solver> make_solver(const gpu::Context& context, const FluidOptions& options,
                                    const shared::SphParams& params)
{
    if (options.solver == shared::SOLVER_DFSPH) {
        return std::make_unique<Dfsph>(context, options, params);
    }
    if (options.solver == shared::SOLVER_PBF) {
        return std::make_unique<Pbf>(context, options, params);
    }
    return std::make_unique<Wcsph>();
}

} // namespace meltpoint::sim
