#pragma once

#include <optional>

#include "particles/particle_set.h"
#include "scene/scene.h"
#include "sim/melting.h"

namespace meltpoint {

/// What heat needs of a scene and its particles at the start; nothing where the scene has no heat.
[[nodiscard]] std::optional<sim::MeltingSettings> melting_settings(const Scene& scene, const ParticleSet& particles);

} // namespace meltpoint
