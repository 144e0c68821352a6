#pragma once

#include <cstdint>
#include <vector>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "shared/hydraulic.h"
#include "sim/exposure.h"
#include "sim/fluid_kernels.h"
#include "sim/neighbor_grid.h"

namespace meltpoint::sim {

/// What hydraulic erosion needs of a scene.
struct HydraulicSettings {
    shared::HydraulicParams params{};
    std::vector<float> strength; ///< positive, by id, 1 of what is usual; empty where all are
};

/// What flow carries off from solids and what of it settles again (shared/hydraulic.h): at the looks of a simulation.
class Hydraulic {
public:
    /// pool: the number of particles. Throws std::logic_error where there are strengths of another number, and Device
    /// when its buffers do not fit.
    Hydraulic(const gpu::Context& context, const FluidOptions& options, const HydraulicSettings& settings,
              std::uint32_t pool);

    /// Nothing is damaged.
    void record_start(gpu::Commands& commands) const;

    /// What flow did in the `seconds` since the last look, and what it does now: before the commands are done
    /// longest_look() is that of the look before. `exposure` must be that of the present solids.
    void record_scour(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                      const NeighborGrid& grid, const Exposure& exposure, double seconds) const;

    /// Sediment becomes solid again where it has rested long enough, `seconds` after the last look, and solids are
    /// freed that are worn away, or will be before the middle of the `next_seconds` until the next look. Both are
    /// counted in `changes`, shared::PoolChanges: they lie among the others yet. When a solid is freed, `time` in s, is
    /// noted in release_time, by id.
    void record_changes(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                        const NeighborGrid& grid, const gpu::Buffer& release_time, const gpu::Buffer& changes,
                        double time, double seconds, double next_seconds) const;

    /// s of motion, the longest from this look to the next: at the present rates nothing loses more than a twentieth of
    /// a particle in it. Infinite where nothing erodes.
    [[nodiscard]] double longest_look() const;

    /// vec2, by id: D as a two-float.
    [[nodiscard]] const gpu::Buffer& damage() const { return damage_; }
    /// D, by id. Waits.
    [[nodiscard]] std::vector<double> download_damage() const;

    [[nodiscard]] std::uint64_t device_bytes() const
    {
        return params_.size() + strength_.size() + damage_.size() + rate_.size() + fastest_.size();
    }

private:
    const gpu::Context* context_;
    std::uint32_t pool_;
    gpu::Kernel scour_;
    gpu::Kernel deposit_;
    gpu::Kernel detach_;
    gpu::Buffer params_;   ///< shared::HydraulicParams
    gpu::Buffer strength_; ///< float, by id
    gpu::Buffer damage_;   ///< vec2, by id: D as a two-float
    gpu::Buffer rate_;     ///< float, by id: dD/dt, 1/s
    gpu::Buffer fastest_;  ///< uint: the bits of the largest of these
    gpu::Buffer readback_; ///< the same
};

} // namespace meltpoint::sim
