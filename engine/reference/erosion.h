#pragma once

#include <cstddef>
#include <span>

#include "reference/state.h"

namespace meltpoint::reference {

/// Twin of sim/front.comp: solid particles whose release time (s, by id) has come turn into fluid, keeping place,
/// velocity, mass and material, or, where they crumble, into dust, which has no weight. How many they are.
std::size_t release(State& state, std::span<const float> release_time, double time);

} // namespace meltpoint::reference
