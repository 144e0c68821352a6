#include "sim/solver.h"

#include "sim/dfsph.h"
#include "sim/pbf.h"
#include "sim/wcsph.h"

namespace meltpoint::sim {

void record_reactions(gpu::Commands& commands, const Fluid& fluid, bool after_viscosity)
{
    if (fluid.boundary_forces != nullptr && after_viscosity == (fluid.viscosity != nullptr)) {
        fluid.boundary_forces->record_forces(commands, fluid);
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
