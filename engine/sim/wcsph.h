#pragma once

#include <cstdint>

#include "sim/solver.h"

namespace meltpoint::sim {

/// The passes of weakly compressible SPH (Mueller et al. 2003 as corrected; Becker & Teschner 2007 for the Tait
/// equation), one function a shader of shaders/sim. `params` holds one shared::SphParams, `status` one shared::Status.

/// v += a dt/2, x += v dt; writes faults of step `step` to status.
void record_kick_drift(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                       const ParticleBuffers& particles, const gpu::Buffer& status, std::uint32_t step);

/// Weight of sorted boundary particles. They do not move, so once is enough. Swaps the particles' positions with the
/// grid's spare buffer.
void record_boundary_weight(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                            ParticleBuffers& particles, NeighborGrid& grid);

/// Density and pressure of sorted particles.
void record_density(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                    const ParticleBuffers& particles, const NeighborGrid& grid);

/// Acceleration of sorted particles from position, half-step velocity, density and pressure.
void record_forces(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                   const ParticleBuffers& particles, const NeighborGrid& grid);

/// v += a dt times `part`.
/// Forces, and what else the fluid's options add to the accelerations.
void record_accelerations(gpu::Commands& commands, const Fluid& fluid);
void record_kick(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                 const ParticleBuffers& particles, float part = 0.5f);

/// For statistics and tests: `counts` gets a shared::NeighborCount for each particle.
void record_count_neighbors(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                            const ParticleBuffers& particles, const NeighborGrid& grid, const gpu::Buffer& counts);

/// What every solver starts from: sorted particles, boundary weights, densities, accelerations; pressures where a state
/// equation gives them.
void record_initial_state(gpu::Commands& commands, const Fluid& fluid);

/// Weakly compressible SPH: pressure from the density by a state equation, velocity Verlet.
class Wcsph : public Solver {
public:
    void record_start(gpu::Commands& commands, const Fluid& fluid) override;
    void record_step(gpu::Commands& commands, const Fluid& fluid, std::uint32_t step) override;
    [[nodiscard]] std::uint32_t scopes() const override { return 9; }
    [[nodiscard]] std::uint64_t device_bytes() const override { return 0; }
};

} // namespace meltpoint::sim
