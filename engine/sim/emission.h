#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "shared/emission.h"
#include "shared/pool_changes.h"
#include "sim/solver.h"

namespace meltpoint::sim {

/// What comes into a scene and goes out of it while it runs.
struct EmissionSettings {
    std::vector<shared::Emitter> emitters; ///< at most shared::MAX_EMITTERS
    std::vector<glm::vec3> points;         ///< m, of the emitters' layers
    std::vector<shared::Sink> sinks;       ///< at most shared::MAX_SINKS

    [[nodiscard]] bool empty() const { return emitters.empty() && sinks.empty(); }
};

/// Births of an emitter up to a time, s since the start of the run: no fewer, and up to a layer more.
[[nodiscard]] std::uint32_t births_until(const shared::Emitter& emitter, double time);

/// Emitters and sinks. The slots of emitters are among the particles from the start: dead, with their mass.
class Emission {
public:
    /// Throws std::logic_error where there are too many of either.
    Emission(const gpu::Context& context, EmissionSettings settings);

    /// At a look at `time` (s since the start): calls up dead slots for the births up to `horizon`, counted in
    /// shared::PoolChanges::called. Those long past for which there was no slot are given up. `gone`: how many
    /// particles are dead and not called up, the last ones of the pool.
    void record_calls(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                      const gpu::Buffer& release_time, const gpu::Buffer& changes, std::uint32_t gone, double time,
                      double horizon);
    /// After the look: notes which births are still to be called up.
    void note_called(const shared::PoolChanges& changes);

    /// After a step that ends `start` s after TimeControl's elapsed time was 0: births, and what is in sinks is dead.
    void record_step(gpu::Commands& commands, const Fluid& fluid, const gpu::Buffer& release_time, float start) const;

    /// Births for which there was no slot, of each emitter, since the start.
    [[nodiscard]] const std::vector<std::uint64_t>& missed() const { return missed_; }

    /// shared::Ledger.
    [[nodiscard]] const gpu::Buffer& ledger() const { return ledger_; }
    [[nodiscard]] std::uint32_t scopes() const { return 1; }
    [[nodiscard]] std::uint64_t device_bytes() const;

private:
    EmissionSettings settings_;
    gpu::Kernel call_up_;
    gpu::Kernel birth_place_;
    gpu::Kernel birth_;
    gpu::Kernel sink_;
    gpu::Buffer emitters_;
    gpu::Buffer points_;
    gpu::Buffer sinks_;
    gpu::Buffer ledger_;
    std::vector<std::uint32_t> next_birth_; ///< of each emitter
    std::vector<std::uint64_t> missed_;
};

} // namespace meltpoint::sim
