#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "shared/pool_changes.h"
#include "sim/fluid_kernels.h"

namespace meltpoint::sim {

/// What turns solid particles into fluid or dust, and counts who changes sides in the pool. Solids are among the still
/// particles; the simulation parts the pool anew after some were freed, have died or were called up.
class Erosion {
public:
    /// Most steps from one look at the solids to the next. Parting a pool takes as long as a step of a fluid a fifth of
    /// its size (measured on a software device): so many keep that below a third of the whole, and none is freed long
    /// after its time.
    [[nodiscard]] static std::uint32_t interval(std::uint32_t pool, std::uint32_t moving)
    {
        return std::clamp(pool / std::max(moving, 1u), 4u, 32u);
    }

    /// release_time: s since the start, by id, when a front reaches a particle; infinite where none does.
    Erosion(const gpu::Context& context, std::span<const float> release_time);

    /// Frees the solid particles that a front has reached at `time` seconds: they lie among the still ones yet. And
    /// counts the dead, which lie among the moving ones yet.
    void record_look(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                     float time) const;
    /// s from a look at `time` to the next, in which fronts reach a fiftieth of all that they ever reach: of more, what
    /// is freed at a look would be a slab. Infinite after the last of them.
    [[nodiscard]] double longest_look(double time) const;
    /// After all of the look's passes: brings what they have found to the host.
    void record_readback(gpu::Commands& commands) const;
    /// What the last look has found: after its commands are done.
    [[nodiscard]] shared::PoolChanges found() const;
    /// shared::PoolChanges, for other passes of a look to count in.
    [[nodiscard]] const gpu::Buffer& changes() const { return changes_; }

    /// s, by id.
    [[nodiscard]] const gpu::Buffer& release_time() const { return release_time_; }

    [[nodiscard]] std::uint64_t device_bytes() const { return release_time_.size() + changes_.size(); }

private:
    gpu::Kernel front_;
    gpu::Kernel count_dead_;
    gpu::Buffer release_time_;
    std::vector<float> arrivals_; ///< s, of those that a front reaches, the first first
    gpu::Buffer changes_;         ///< shared::PoolChanges
    gpu::Buffer readback_;        ///< the same
};

} // namespace meltpoint::sim
