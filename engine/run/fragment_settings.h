#pragma once

#include <optional>

#include "scene/scene.h"
#include "sim/fragments.h"

namespace meltpoint {

/// What fragments need of a scene; nothing where no piece of a solid can break off.
[[nodiscard]] std::optional<sim::FragmentSettings> fragment_settings(const Scene& scene);

} // namespace meltpoint
