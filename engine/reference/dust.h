#pragma once

#include <span>

#include "reference/state.h"
#include "shared/dust.h"

namespace meltpoint::reference {

/// The velocity of the air at x (m) and a time (s since the start), m/s: the wind, and the waves that it carries along.
[[nodiscard]] glm::dvec3 air_velocity(const shared::DustParams& dust, const glm::dvec3& x, double time);

/// Twin of sim/dust.comp: dust takes a step of params.dt that ends at `time`. release_time: s, by id.
void drift_dust(const Settings& settings, const shared::DustParams& dust, State& state,
                std::span<const float> release_time, double time);

} // namespace meltpoint::reference
