#pragma once

#include <cstdint>
#include <optional>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "sim/fluid_kernels.h"
#include "sim/neighbor_grid.h"

namespace meltpoint::sim {

/// What any solver may do to the velocities besides its own work, where the options ask for it: XSPH, which takes away
/// what differs from particle to particle, and vorticity confinement, which gives back the swirls that are lost so.
class Vorticity {
public:
    Vorticity(const gpu::Context& context, const FluidOptions& options, std::uint32_t particle_count);

    /// Before the first step: still particles have no vorticity.
    void record_start(gpu::Commands& commands) const;
    /// XSPH of sorted particles with densities (Schechter & Bridson 2012, after Monaghan 1989). Swaps the particles'
    /// velocities with the grid's spare buffer. Nothing where options.xsph is not set.
    void record_xsph(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                     ParticleBuffers& particles, NeighborGrid& grid);
    /// Adds confinement (Macklin & Mueller 2013) to the accelerations of sorted particles with densities. Nothing where
    /// options.confinement is not set.
    void record_confinement(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                            const ParticleBuffers& particles, const NeighborGrid& grid);

    /// Scopes (timestamps) of a step.
    [[nodiscard]] std::uint32_t scopes() const { return (xsph_ ? 1u : 0u) + (curl_ ? 1u : 0u); }
    /// Device memory of its own.
    [[nodiscard]] std::uint64_t device_bytes() const { return curl_ ? curl_->vorticity.size() : 0; }
    /// vec4 a particle: curl of the velocity, 1/s, and the volume of fluid; null without confinement.
    [[nodiscard]] const gpu::Buffer* vorticity() const { return curl_ ? &curl_->vorticity : nullptr; }

private:
    struct Curl {
        gpu::Kernel kernel;
        gpu::Kernel confinement;
        gpu::Buffer vorticity;
    };
    std::optional<gpu::Kernel> xsph_;
    std::optional<Curl> curl_;
};

} // namespace meltpoint::sim
