#pragma once

#include "gpu/commands.h"
#include "shared/dust.h"
#include "sim/solver.h"

namespace meltpoint::sim {

/// How dust moves (shared/dust.h): one pass at the end of every step, whatever the solver.
class Dust {
public:
    Dust(const gpu::Context& context, const shared::DustParams& params);

    /// Moves dust by the step that has just been taken. release_time: s since the start, by id; `start`: s since the
    /// start when TimeStep::elapsed was 0.
    void record(gpu::Commands& commands, const Fluid& fluid, const gpu::Buffer& release_time, const gpu::Buffer& ledger,
                float start) const;

private:
    gpu::Kernel drift_;
    gpu::Buffer params_; ///< shared::DustParams
};

} // namespace meltpoint::sim
