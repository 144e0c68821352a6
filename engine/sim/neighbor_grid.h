#pragma once

#include <cstdint>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "primitives/counting_sort.h"
#include "shared/gather.h"
#include "shared/sph_params.h"
#include "sim/fluid_kernels.h"

namespace meltpoint::sim {

/// Cells along x (half a support radius long), y and z (one support radius) that cover the domain.
[[nodiscard]] glm::uvec3 grid_size(const glm::vec3& domain_min, const glm::vec3& domain_max, float support_radius);

/// Uniform grid over the domain: the particles are sorted by (cell, id), so a row of cells is one range of particles,
/// or two where some are still (shared/sph_params.h).
struct NeighborGrid {
    /// Words of neighbor_bits a particle, where the device's buffers may be so large: those of most tiles at H = 2 d
    /// and 3 d, images included. No result depends on it.
    static constexpr std::uint32_t neighbor_words = 12;

    /// has_still: whether there may be still particles. Throws Input when the domain has more cells than a device of
    /// this kind can hold.
    NeighborGrid(const gpu::Context& context, std::uint32_t particle_count, const glm::uvec3& size, bool has_still);

    std::uint32_t cell_count;
    bool still; ///< has a table of cells for still particles
    primitives::CountingSort sort;
    gpu::Buffer key;        ///< uint: cell of each particle, in the order before the sort
    gpu::Buffer order;      ///< uint: sorted slot -> place before the sort
    gpu::Buffer cell_start; ///< uint: starts in the sorted order of each cell, of each again among the still, of the
                            ///< dead, and the end
    primitives::CountingSort::Scratch scratch;
    // Where reorder writes; swapped with the particles' own buffers afterwards.
    gpu::Buffer sorted_id;
    gpu::Buffer sorted_attributes;
    gpu::Buffer sorted_position;
    gpu::Buffer sorted_velocity;
    gpu::Buffer spare;         ///< float: where a partition writes, swapped likewise
    gpu::Buffer neighbor_bits; ///< uint: which candidates are neighbors (shaders/include/neighbor_bits.glsl)
};

/// Brings the first `count` elements of an array of so many 32-bit words each into the order of the last sort.
void record_gather(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& order,
                   const gpu::Buffer& source, const gpu::Buffer& target, shared::GatherPush push);

/// Sorts all particles with all that they carry from one step to the next: the moving ones by (cell, id), then the
/// still ones, boundary particles, of which there must be particles.count - particles.moving. Has to be done again
/// whenever others are still; record_settle comes after it.
void record_partition(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                      ParticleBuffers& particles, NeighborGrid& grid);

/// What steps expect of still particles: their interaction, and that they lie in both of the buffers that a step swaps.
void record_settle(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                   const ParticleBuffers& particles, const NeighborGrid& grid);

/// Sorts the moving particles by (cell, id): key, counting sort, reorder. Swaps particles' buffers with the grid's.
void record_sort(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                 ParticleBuffers& particles, NeighborGrid& grid);

} // namespace meltpoint::sim
