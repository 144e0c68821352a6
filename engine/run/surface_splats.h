#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace meltpoint {

/// Flat discs on surfaces, one array an attribute, all of the same length: the host form of render::DiscBuffers.
struct SurfaceSplats {
    std::vector<glm::vec4> position_radius; ///< m
    std::vector<glm::vec4> normal;          ///< unit, outward; w is 0
    std::vector<glm::vec4> color;           ///< linear RGB; w is 1
};

/// The splats of a scene's surfaces, in the order of the file. Throws Input for meshes and scans that cannot be read or
/// have no area, and for more splats than `limit` (what the device holds).
[[nodiscard]] SurfaceSplats make_surface_splats(const Scene& scene, std::uint64_t limit);

} // namespace meltpoint
