#pragma once

#include <cstdint>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "sim/fluid_kernels.h"
#include "sim/neighbor_grid.h"

namespace meltpoint::sim {

/// Surface tension and contact angles in SI units, of any solver: a force from the curvature of the surface (Brackbill,
/// Kothe & Zemach 1992; Morris 2000; shared/capillarity.h).
class Capillarity {
public:
    /// Throws Device when its buffers do not fit.
    Capillarity(const gpu::Context& context, const FluidOptions& options, std::uint32_t particle_count);

    /// Before the first step: still particles have no normals.
    void record_start(gpu::Commands& commands) const;
    /// Adds tension to the accelerations of sorted particles with densities: the three below, one after the other.
    void record(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                const ParticleBuffers& particles, const NeighborGrid& grid);

    void record_normals(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                        const ParticleBuffers& particles, const NeighborGrid& grid);
    /// Smooths the normals once.
    void record_smoothing(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                          const ParticleBuffers& particles, const NeighborGrid& grid);
    void record_forces(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                       const ParticleBuffers& particles, const NeighborGrid& grid);

    /// vec4 a particle: 1/m, and the tension of its fluid, N/m.
    [[nodiscard]] const gpu::Buffer& gradient() const { return gradient_; }
    [[nodiscard]] const gpu::Buffer& normal() const { return normal_; }
    /// Device memory of its own.
    [[nodiscard]] std::uint64_t device_bytes() const { return gradient_.size() + normal_.size() + smoothed_.size(); }

private:
    gpu::Kernel surface_normal_;
    gpu::Kernel smooth_normal_;
    gpu::Kernel force_;
    gpu::Buffer gradient_;
    gpu::Buffer normal_;
    gpu::Buffer smoothed_; ///< where the next smoothing goes
};

} // namespace meltpoint::sim
