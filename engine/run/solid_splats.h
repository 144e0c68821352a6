#pragma once

#include <cstdint>
#include <vector>

#include "particles/particle_set.h"
#include "scene/scene.h"
#include "shared/solid_splats.h"

namespace meltpoint {

/// Whether a scene's solids are drawn as splats: those in space are.
[[nodiscard]] bool has_solid_splats(const Scene& scene);

/// How the scene's solids look and what frees them (shared/solid_splats.h).
[[nodiscard]] shared::SolidSplatParams solid_splat_params(const Scene& scene);

/// Splats on the surfaces of the scene's solids, with their hosts among `particles`, which are those of the start.
/// There are none where a solid covers another one, or where one is too thin for three particles to lie below a splat.
/// At most `limit`: where there were more, they are larger. Throws Input for meshes that cannot be read.
[[nodiscard]] std::vector<shared::HostedSplat> make_hosted_splats(const Scene& scene, const ParticleSet& particles,
                                                                  std::uint64_t limit);

} // namespace meltpoint
