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

/// What the surface of a scene's solids is made of.
struct SolidSurface {
    std::vector<shared::HostedSplat> splats;
    std::vector<std::uint32_t> cover; ///< the splat above each particle, by id, or shared::NO_COVER
};

/// Splats on the surfaces of the scene's solids, with their hosts among `particles`, which are those of the start.
/// There are none where a solid covers another one, or where one is too thin for three particles to lie below a splat.
/// At most `limit`: where there were more, they are larger. Throws Input for meshes that cannot be read.
[[nodiscard]] SolidSurface make_solid_surface(const Scene& scene, const ParticleSet& particles, std::uint64_t limit);

} // namespace meltpoint
