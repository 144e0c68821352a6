#pragma once

#include "gpu/commands.h"
#include "particles/particle_set.h"
#include "sim/solver.h"

namespace meltpoint::sim {

/// What was solid takes on the volume of its fluid (shared/volume_relaxation.h).
class VolumeRelaxation {
public:
    explicit VolumeRelaxation(const gpu::Context& context);

    /// Whether some solids have another volume than their fluid.
    [[nodiscard]] static bool is_needed(const ParticleSet& particles);

    /// The end of a step.
    void record(gpu::Commands& commands, const Fluid& fluid) const;

    /// Timestamps of a step.
    [[nodiscard]] static std::uint32_t scopes() { return 1; }

private:
    gpu::Kernel relax_;
};

} // namespace meltpoint::sim
