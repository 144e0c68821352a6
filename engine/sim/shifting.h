#pragma once

#include <cstdint>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "sim/fluid_kernels.h"
#include "sim/neighbor_grid.h"

namespace meltpoint::sim {

/// Particle shifting (Lind, Xu, Stansby & Rogers 2012): keeps particles evenly spread where pressures below zero would
/// clump them, in flows without a free surface. Any solver that has velocities may have it.
class Shifting {
public:
    Shifting(const gpu::Context& context, const FluidOptions& options);

    /// Moves sorted particles whose volumes and neighbors are those of their present positions. Swaps the particles'
    /// positions with the grid's spare buffer.
    void record(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                ParticleBuffers& particles, NeighborGrid& grid) const;

private:
    gpu::Kernel shift_;
};

} // namespace meltpoint::sim
