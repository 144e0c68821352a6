#include "reference/erosion.h"

namespace meltpoint::reference {

std::size_t release(State& state, std::span<const float> release_time, double time)
{
    std::size_t freed = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (shared::particle_state(state.attributes[i]) == shared::STATE_SOLID &&
            time >= static_cast<double>(release_time[state.id[i]])) {
            const bool crumbles = (state.attributes[i] & shared::FLAG_CRUMBLES) != 0;
            state.attributes[i] = shared::freed_as(
                state.attributes[i], crumbles ? shared::STATE_DUST : shared::STATE_FLUID, shared::CAUSE_FRONT);
            state.weight[i] = crumbles ? 0.0 : state.weight[i];
            ++freed;
        }
    }
    return freed;
}

} // namespace meltpoint::reference
