#pragma once

#include <cstdint>

#include "particles/particle_set.h"
#include "scene/scene.h"

namespace meltpoint {

/// The particles of a scene's fluids at time 0: shapes filled, masses from rest density and measured volume, velocities
/// set. Material of a particle: its fluid's entry in scene_materials(scene). Throws Input for meshes that cannot be
/// read or filled, fluid outside the domain, and more than `limit` particles (what the device holds).
[[nodiscard]] ParticleSet make_particles(const Scene& scene, std::uint64_t limit);

} // namespace meltpoint
