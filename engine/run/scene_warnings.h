#pragma once

#include <string>
#include <vector>

#include "particles/particle_set.h"
#include "scene/scene.h"

namespace meltpoint {

/// Sentences about values of a scene that do not do what they seem to: keys that nothing reads, contact angles
/// and surface tension without effect or at a support that they are not measured for, a lid that drags nothing along, a
/// fall that has no end, shifting at a free surface, positions coarser than a particle can bear.
[[nodiscard]] std::vector<std::string> scene_warnings(const Scene& scene, const ParticleSet& particles);

} // namespace meltpoint
