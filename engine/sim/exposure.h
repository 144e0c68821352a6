#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "shared/exposure.h"
#include "sim/fluid_kernels.h"
#include "sim/neighbor_grid.h"

namespace meltpoint::sim {

/// Where solids are exposed (shared/exposure.h): what sun, wind and air have to work on.
class Exposure {
public:
    /// Throws Device when its buffer does not fit.
    Exposure(const gpu::Context& context, const FluidOptions& options, std::uint32_t pool);

    /// Nobody is exposed.
    void record_start(gpu::Commands& commands) const;

    /// Computes the exposure of solid particles from where solids and colliders are now, which must lie among the still
    /// ones in their cells (record_partition): of all, or of the still ones `first` .. `first` + `count` - 1. Leaves
    /// that of others as it was. Nothing to do where nobody is still.
    void record(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                const NeighborGrid& grid, std::uint32_t first = 0, std::uint32_t count = ~0u) const;
    /// The same where some solids are loose, and lie among the moving ones: of all.
    void record_with_loose(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                           const NeighborGrid& grid) const;

    /// By id: vec4, the normal and in w the exposed area in m^2 (in the plane m); zero of those inside. Of a particle
    /// that is no longer solid it is what it was last.
    [[nodiscard]] const gpu::Buffer& exposure() const { return exposure_; }
    /// The same. Waits.
    [[nodiscard]] std::vector<glm::vec4> download() const;

    [[nodiscard]] std::uint64_t device_bytes() const { return exposure_.size(); }

private:
    /// Of the particles first .. end - 1 in their order.
    void record_range(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                      const NeighborGrid& grid, std::uint32_t first, std::uint32_t end, bool any_loose) const;

    const gpu::Context* context_;
    std::uint32_t pool_;
    gpu::Kernel kernel_;
    gpu::Buffer exposure_;
    shared::ExposurePush scales_; ///< but for the range
};

} // namespace meltpoint::sim
