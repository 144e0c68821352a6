#pragma once

#include <optional>

#include "scene/scene.h"
#include "sim/wind.h"

namespace meltpoint {

/// What wind needs of a scene; nothing where the scene has no sand.
[[nodiscard]] std::optional<sim::WindSettings> wind_settings(const Scene& scene);

} // namespace meltpoint
