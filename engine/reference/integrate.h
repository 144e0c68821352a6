#pragma once

#include "reference/state.h"

namespace meltpoint::reference {

/// Twin of sim/kick.comp: v += a t, t in seconds.
void kick(State& state, double t);

/// Twin of include/contact.glsl: a velocity (m/s) without what would bring a particle nearer to a wall than
/// params.contact_distance in `seconds`; a move (m) where that is 1.
[[nodiscard]] glm::dvec3 held_off_walls(const shared::SphParams& params, const glm::dvec3& position,
                                        glm::dvec3 velocity, double seconds);

/// First half of the twin of sim/drift.comp: holds all velocities off the walls in this step.
void hold_off_walls(const Settings& settings, State& state);

/// Twin of sim/kick_drift.comp and sim/drift.comp: x += v dt, then the watch. Boundary particles stay where they are.
void drift(const Settings& settings, State& state);

/// Twin of include/watch.glsl. Looks for faults: a position or velocity that is not finite, a particle outside the
/// domain (which sets FLAG_LEFT_DOMAIN too), a speed above params.speed_limit; of several, the one named first here.
/// The state keeps the first step that had one, and in it the particle of smallest id.
void watch(const Settings& settings, State& state);

} // namespace meltpoint::reference
