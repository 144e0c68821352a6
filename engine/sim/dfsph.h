#pragma once

#include "sim/solver.h"

namespace meltpoint::sim {

/// Divergence-free SPH (Bender & Koschier, "Divergence-Free SPH for Incompressible and Viscous Fluids", IEEE TVCG
/// 2017). A step: sort, density and diagonal; velocities without divergence; forces other than pressure; velocities
/// that bring the density back to rest; drift. Both solves are Jacobi iterations that end on the device, warm started
/// with the pressures of the step before.
class Dfsph : public Solver {
public:
    Dfsph(const gpu::Context& context, const FluidOptions& options, const shared::SphParams& params);

    void record_start(gpu::Commands& commands, const Fluid& fluid) override;
    void record_step(gpu::Commands& commands, const Fluid& fluid, std::uint32_t step) override;
    void record_carry(gpu::Commands& commands, const Fluid& fluid) override;
    [[nodiscard]] std::uint32_t scopes() const override { return 13; }
    [[nodiscard]] std::uint64_t device_bytes() const override;
    [[nodiscard]] const gpu::Buffer* solves() const override { return &solves_; }

    // The passes, for those who compare them with their twins.

    /// Sorts particles and warm starts.
    void record_sort(gpu::Commands& commands, const Fluid& fluid);
    /// grid.sorted_velocity from the velocities and the pressures of the present iterate. Nothing once the solve has
    /// ended.
    void record_correct(gpu::Commands& commands, const Fluid& fluid, std::uint32_t solve);
    /// What the velocities lead to, the next iterate and whether the solve has ended. Iteration 0 looks at the
    /// particles' own velocities and makes the warm start the first iterate, later ones at grid.sorted_velocity.
    void record_residual(gpu::Commands& commands, const Fluid& fluid, shared::ResidualPush push);
    /// A whole solve (shared::SOLVE_*), after which particles.velocity is what it has found.
    void record_solve(gpu::Commands& commands, const Fluid& fluid, std::uint32_t solve);

    /// x += v dt, held off the walls; pressure; faults of step `step`.
    void record_drift(gpu::Commands& commands, const Fluid& fluid, std::uint32_t step);

    /// By shared::SOLVE_*, of the last solves: the impulses that have acted, and dt times these, over gradient_scale.
    [[nodiscard]] const gpu::Buffer& warm_start() const { return warm_start_; }
    /// The last iterate without momentum, over gradient_scale.
    [[nodiscard]] const gpu::Buffer& jacobi_step() const { return jacobi_step_; }

private:
    /// Warm starts of the first `count` particles into the order of the last sort.
    void record_reorder(gpu::Commands& commands, const Fluid& fluid, std::uint32_t count);

    std::uint32_t max_iterations_;
    std::uint32_t particles_;
    gpu::Kernel correct_;
    gpu::Kernel residual_;
    gpu::Kernel drift_;
    gpu::Buffer warm_start_;        ///< vec2 a particle: one float a solve
    gpu::Buffer sorted_warm_start_; ///< where reorder writes
    gpu::Buffer jacobi_step_;       ///< float a particle: the last iterate without momentum
    gpu::Buffer errors_;            ///< vec2 a workgroup
    gpu::Buffer solves_;            ///< shared::Solve[SOLVES]
};

} // namespace meltpoint::sim
