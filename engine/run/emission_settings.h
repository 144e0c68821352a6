#pragma once

#include <cstdint>

#include "particles/particle_set.h"
#include "scene/scene.h"
#include "sim/emission.h"

namespace meltpoint {

/// The emitters and sinks of a scene, which is in its dimensions (run/plane_scene). An emitter's particles are layers
/// of its lattice, so far apart that it brings exactly density times area times speed; or drops at random places and
/// times, a mean `rate`. Its slots are as many as it has, or as are born in the time of the run. first_id: of the first
/// emitter's slots; the others' follow.
[[nodiscard]] sim::EmissionSettings emission_settings(const Scene& scene, std::uint32_t first_id);
/// The same where the slots are among the particles: its dead ones.
[[nodiscard]] sim::EmissionSettings emission_settings(const Scene& scene, const ParticleSet& particles);

/// Mass of a particle that an emitter brings, kg; in two dimensions kg per meter of depth.
[[nodiscard]] double emitted_mass(const Scene& scene, const EmitterBody& emitter);

} // namespace meltpoint
