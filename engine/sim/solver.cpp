#include "sim/solver.h"

#include "sim/dfsph.h"
#include "sim/wcsph.h"

namespace meltpoint::sim {

std::unique_ptr<Solver> make_solver(const gpu::Context& context, const FluidOptions& options,
                                    const shared::SphParams& params)
{
    if (options.solver == shared::SOLVER_DFSPH) {
        return std::make_unique<Dfsph>(context, options, params);
    }
    return std::make_unique<Wcsph>();
}

} // namespace meltpoint::sim
