#include "reference/volume_relaxation.h"

#include <cmath>

#include "shared/volume_relaxation.h"

namespace meltpoint::reference {

void relax_volumes(State& state)
{
    const double kept = 1.0 - 1.0 / static_cast<double>(shared::VOLUME_RELAXATION_STEPS);
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (shared::particle_state(state.attributes[i]) == shared::STATE_FLUID) {
            const double left = kept * (state.weight[i] - 1.0);
            state.weight[i] = std::abs(left) < static_cast<double>(shared::VOLUME_TOLERANCE) ? 1.0 : 1.0 + left;
        }
    }
}

} // namespace meltpoint::reference
