#pragma once

#include "sim/solver.h"

namespace meltpoint::sim {

/// Position based fluids (Macklin & Mueller, "Position Based Fluids", ACM Trans. Graph. 32(4), 2013; shared/pbf.h has
/// the equations). A step: predicted positions; sort, density and the forces other than pressure there; Jacobi
/// iterations that move the particles until they keep their density; velocities from the moves. Iterations end on the
/// device when the error is met, or after a set number of them.
///
/// Neighbors are found once a step, at the predicted positions: pairs that come nearer than the support radius in the
/// course of the iterations do not meet. With moves of at most m (SolveStatistics::farthest_move) such pairs are
/// farther apart than the support radius less 2 m, where kernels have all but vanished.
class Pbf : public Solver {
public:
    Pbf(const gpu::Context& context, const FluidOptions& options, const shared::SphParams& params);

    void record_start(gpu::Commands& commands, const Fluid& fluid) override;
    void record_step(gpu::Commands& commands, const Fluid& fluid, std::uint32_t step) override;
    void record_carry(gpu::Commands& commands, const Fluid& fluid) override;
    [[nodiscard]] std::uint32_t scopes() const override { return 9; }
    [[nodiscard]] std::uint64_t device_bytes() const override;
    [[nodiscard]] const gpu::Buffer* solves() const override { return &solves_; }

    // The passes, for those who compare them with their twins.

    /// Before the first step: still particles do not move.
    void record_still(gpu::Commands& commands, const Fluid& fluid) const;
    /// x += v dt, held off the walls.
    void record_predict(gpu::Commands& commands, const Fluid& fluid);
    /// moved() from the predicted positions and move(), which iteration 0 begins with accelerations. Nothing once the
    /// solve has ended.
    void record_move(gpu::Commands& commands, const Fluid& fluid, std::uint32_t iteration);
    /// Densities at moved(), what the constraints there ask for, and whether the solve has ended.
    void record_residual(gpu::Commands& commands, const Fluid& fluid, std::uint32_t iteration);
    /// move() += what the constraints ask for. Nothing once the solve has ended.
    void record_correct(gpu::Commands& commands, const Fluid& fluid);
    /// All iterations.
    void record_solve(gpu::Commands& commands, const Fluid& fluid);
    /// Velocities, positions and pressure; faults of step `step`.
    void record_finish(gpu::Commands& commands, const Fluid& fluid, std::uint32_t step);

    [[nodiscard]] const gpu::Buffer& move() const { return move_; }
    [[nodiscard]] const gpu::Buffer& moved() const { return moved_; }

private:
    std::uint32_t max_iterations_;
    std::uint32_t particles_;
    gpu::Kernel predict_;
    gpu::Kernel move_kernel_;
    gpu::Kernel residual_;
    gpu::Kernel correct_;
    gpu::Kernel finish_;
    gpu::Buffer move_;   ///< vec4 a particle, m: from the predicted position to the present one
    gpu::Buffer moved_;  ///< vec4 a particle: present position, weight
    gpu::Buffer errors_; ///< vec2 a workgroup
    gpu::Buffer solves_; ///< shared::Solve[SOLVES], of which SOLVE_DENSITY is used
};

} // namespace meltpoint::sim
