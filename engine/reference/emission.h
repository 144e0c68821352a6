#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/state.h"
#include "shared/emission.h"

namespace meltpoint::reference {

/// Where a birth takes place, m.
[[nodiscard]] glm::dvec3 birth_place(const shared::Emitter& emitter, std::span<const glm::vec3> points,
                                     std::uint32_t birth);

/// Twin of sim/call_up.comp: calls up an emitter's dead slots of smallest id for `births` of its births from
/// `first_birth` on, as many as there are. Writes their times to release_time (s, by id). gone: by id, who lies behind
/// all others, being dead when the pool was last parted. How many are called up.
std::size_t call_up(State& state, const shared::Emitter& emitter, std::span<const glm::vec3> points,
                    std::uint32_t first_birth, std::uint32_t births, const std::vector<bool>& gone,
                    std::span<float> release_time);

/// Twin of sim/birth_place.comp and sim/birth.comp: those who were called up and whose time has come are fluid, or dead
/// where another particle is nearer than shared::BIRTH_DISTANCE spacings. settings.params.dt: of the step that ends at
/// `time`, s since the start. How many are born.
std::size_t bear(const Settings& settings, State& state, std::span<const float> release_time, double time);

/// Twin of sim/sink.comp: fluid and dust in a sink is dead. How many particles that are.
std::size_t sink(State& state, std::span<const shared::Sink> sinks);

} // namespace meltpoint::reference
