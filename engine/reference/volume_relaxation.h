#pragma once

#include "reference/state.h"

namespace meltpoint::reference {

/// Twin of sim/relax_volume.comp: the weights of fluid after another step (shared/volume_relaxation.h).
void relax_volumes(State& state);

} // namespace meltpoint::reference
