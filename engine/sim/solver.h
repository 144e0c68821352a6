#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "shared/solve.h"
#include "sim/boundary_forces.h"
#include "sim/capillarity.h"
#include "sim/fluid_kernels.h"
#include "sim/neighbor_grid.h"
#include "sim/shifting.h"
#include "sim/time_control.h"
#include "sim/vorticity.h"

namespace meltpoint::sim {

class ImplicitViscosity;

/// What the passes of a step work on.
struct Fluid {
    const FluidKernels& kernels;
    const gpu::Buffer& params; ///< shared::SphParams
    ParticleBuffers& particles;
    NeighborGrid& grid;
    const gpu::Buffer& status; ///< shared::Status
    TimeControl& time;
    Vorticity& vorticity;
    BoundaryForces* boundary_forces = nullptr; ///< null where nobody measures them
    BoundaryForces* forces_on_loose = nullptr; ///< null where no solid is loose
    ImplicitViscosity* viscosity = nullptr;    ///< null where viscosity is a force like the others
    const Shifting* shifting = nullptr;        ///< null where particles stay where their velocities lead them
    Capillarity* capillarity = nullptr;        ///< null where no fluid has tension in SI units
};

/// Where, in a buffer of shared::Solve[SOLVES], the workgroups of a solve's next iteration are.
constexpr VkDeviceSize arguments_of(std::uint32_t solve)
{
    return solve * sizeof(shared::Solve) + offsetof(shared::Solve, groups);
}

/// How a fluid gets its pressure and takes a step: the one interface of all solvers.
class Solver {
public:
    virtual ~Solver() = default;

    /// Before the first step: what a step expects to find, and density, pressure and acceleration of the initial state.
    virtual void record_start(gpu::Commands& commands, const Fluid& fluid) = 0;
    /// One time step; `step` is its number, which a fault is reported with.
    virtual void record_step(gpu::Commands& commands, const Fluid& fluid, std::uint32_t step) = 0;

    /// After record_partition: what it carries itself from one step to the next follows the particles.
    virtual void record_carry(gpu::Commands& /*commands*/, const Fluid& /*fluid*/) {}

    /// Scopes (timestamps) of a step, at most, without those of Fluid::vorticity.
    [[nodiscard]] virtual std::uint32_t scopes() const = 0;
    /// Device memory of its own.
    [[nodiscard]] virtual std::uint64_t device_bytes() const = 0;
    /// shared::Solve[shared::SOLVES]; null where nothing is solved for.
    [[nodiscard]] virtual const gpu::Buffer* solves() const { return nullptr; }
};

/// The forces of fluid on boundary particles, where they are measured: friction is that of the velocities before the
/// kick, or, solved for, of those that the solve has found. To be called at both places.
void record_reactions(gpu::Commands& commands, const Fluid& fluid, bool after_viscosity);
/// The same of impulses, after both solves of a step. warm_start: Dfsph::warm_start().
void record_reaction_impulses(gpu::Commands& commands, const Fluid& fluid, const gpu::Buffer& warm_start);

/// The solver that options.solver names. Throws Device when its buffers do not fit.
[[nodiscard]] std::unique_ptr<Solver> make_solver(const gpu::Context& context, const FluidOptions& options,
                                                  const shared::SphParams& params);

} // namespace meltpoint::sim
