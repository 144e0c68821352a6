#pragma once

#include <cstdint>

#include "gpu/commands.h"
#include "gpu/kernel.h"
#include "shared/viscosity_solve.h"
#include "sim/solver.h"

namespace meltpoint::sim {

/// Viscosity solved for at the end of each step instead of taken at its start, so that it does not bound the step
/// (Weiler, Koschier, Brand & Bender, "A Physically Consistent Implicit Viscosity Solver for SPH Fluids", Eurographics
/// 2018): preconditioned conjugate gradients that end on the device. See shaders/shared/viscosity_solve.h.
class ImplicitViscosity {
public:
    /// Throws Device when its buffers do not fit.
    ImplicitViscosity(const gpu::Context& context, const FluidOptions& options, const shared::SphParams& params);

    /// Before the first step.
    void record_start(gpu::Commands& commands);
    /// What viscosity does to particles.velocity in params.dt. The particles are sorted and have densities, and have
    /// been sorted once since the last solve.
    /// After record_partition: what a solve starts from follows the particles.
    void record_carry(gpu::Commands& commands, const Fluid& fluid);
    void record_solve(gpu::Commands& commands, const Fluid& fluid);

    // The passes, for those who compare them with their twins.

    /// The change of velocity that the solve starts from, its residual and the preconditioner.
    void record_residual(gpu::Commands& commands, const Fluid& fluid);
    /// The next direction. This and what follows do nothing once the solve has ended.
    void record_direction(gpu::Commands& commands, const Fluid& fluid);
    /// A times the direction.
    void record_product(gpu::Commands& commands, const Fluid& fluid);
    /// A step along the direction, and whether the solve ends with this iteration (from 1 on).
    void record_update(gpu::Commands& commands, const Fluid& fluid, std::uint32_t iteration);
    /// Velocities with what the solve has found.
    void record_end(gpu::Commands& commands, const Fluid& fluid);

    /// vec4 a particle: between solves, what viscosity did in the last one, m/s^2; during one, m/s.
    [[nodiscard]] const gpu::Buffer& change() const { return change_; }
    /// vec4 a particle, m/s.
    [[nodiscard]] const gpu::Buffer& residual() const { return residual_; }
    /// vec4 a particle, m/s.
    [[nodiscard]] const gpu::Buffer& direction() const { return direction_; }
    /// vec4 a particle, m/s: A times the direction.
    [[nodiscard]] const gpu::Buffer& product() const { return product_; }
    /// shared::ViscosityBlock a particle.
    [[nodiscard]] const gpu::Buffer& blocks() const { return blocks_; }
    /// One shared::ViscositySolve, a shared::Solve at its start.
    [[nodiscard]] const gpu::Buffer& state() const { return state_; }
    /// Device memory.
    [[nodiscard]] std::uint64_t device_bytes() const;

private:
    std::uint32_t max_iterations_;
    std::uint32_t particles_;
    gpu::Kernel start_;
    gpu::Kernel initial_residual_;
    gpu::Kernel next_direction_;
    gpu::Kernel apply_;
    gpu::Kernel update_;
    gpu::Kernel end_;
    gpu::Buffer change_;
    gpu::Buffer residual_;
    gpu::Buffer direction_;
    gpu::Buffer product_; ///< and where the sorted change goes at the start
    gpu::Buffer blocks_;
    gpu::Buffer sums_; ///< vec4 a workgroup
    gpu::Buffer state_;
};

} // namespace meltpoint::sim
