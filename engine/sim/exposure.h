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
    /// Of `pool` particles in a grid of so many cells. Throws Device when its buffers do not fit.
    Exposure(const gpu::Context& context, const FluidOptions& options, std::uint32_t pool, std::uint32_t cells);

    /// Nobody is exposed, or known.
    void record_start(gpu::Commands& commands);

    /// Computes the exposure of solid particles from where solids and colliders are now, which must lie among the still
    /// ones in their cells (record_partition): of all, or of the still ones `first` .. `first` + `count` - 1. Leaves
    /// that of others as it was. Nothing to do where nobody is still.
    void record(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                const NeighborGrid& grid, std::uint32_t first = 0, std::uint32_t count = ~0u) const;
    /// The same where solids and colliders are otherwise than at the last call, or record_start: elsewhere it is as it
    /// was. any_loose: some solids are loose, and lie among the moving ones. Who is no longer solid is not exposed.
    void record_changes(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                        const NeighborGrid& grid, bool any_loose);

    /// By id: vec4, the normal and in w the exposed area in m^2 (in the plane m); zero of those inside. Of a particle
    /// that is no longer solid it is what it was last.
    [[nodiscard]] const gpu::Buffer& exposure() const { return exposure_; }
    /// The same. Waits.
    [[nodiscard]] std::vector<glm::vec4> download() const;

    [[nodiscard]] std::uint64_t device_bytes() const { return exposure_.size() + known_.size() + marks_.size(); }

private:
    /// Of the particles first .. end - 1 in their order. push: range apart.
    void record_range(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                      const NeighborGrid& grid, std::uint32_t first, std::uint32_t end,
                      shared::ExposurePush push) const;

    const gpu::Context* context_;
    std::uint32_t pool_;
    gpu::Kernel change_;
    gpu::Kernel kernel_;
    gpu::Buffer exposure_;
    gpu::Buffer known_;           ///< vec4 by id: place and weight of solids and colliders when changes were recorded last
    gpu::Buffer marks_;           ///< uint a cell: the round in which somebody near had changed
    std::uint32_t round_ = 0;     ///< of record_changes
    shared::ExposurePush scales_; ///< but for the range
};

} // namespace meltpoint::sim
