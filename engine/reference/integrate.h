#pragma once

#include "reference/state.h"

namespace meltpoint::reference {

/// Twin of sim/kick.comp: v += a t, t in seconds.
void kick(State& state, double t);

/// First half of the twin of sim/drift.comp: takes the velocity that would bring a particle nearer to a wall than
/// params.contact_distance in this step.
void hold_off_walls(const Settings& settings, State& state);

/// Twin of sim/kick_drift.comp and sim/drift.comp: x += v dt, then looks for faults: a position or velocity that is not
/// finite, a particle outside the domain (which sets FLAG_LEFT_DOMAIN too), a speed above params.speed_limit; of
/// several, the one named first here. Boundary particles stay where they are. The state keeps the first step that had
/// one, and in it the particle of smallest id.
void drift(const Settings& settings, State& state);

} // namespace meltpoint::reference
