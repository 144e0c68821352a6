#pragma once

#include "scene/scene.h"
#include "shared/dust.h"

namespace meltpoint {

/// The air that a scene's dust drifts with: waves of random direction and phase, seeded with the scene's seed, between
/// the largest eddies and those a quarter of their size, whose velocities fall with the cube root of their size
/// (Kolmogorov 1941) and have the root mean square that the scene asks for. In two dimensions all of it lies in the
/// plane.
[[nodiscard]] shared::DustParams dust_params(const Scene& scene);

} // namespace meltpoint
