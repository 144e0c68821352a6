#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include "geometry/solid.h"
#include "scene/scene.h"

namespace meltpoint {

struct ColliderSamples {
    std::vector<glm::vec3> points;       ///< its boundary particles, m
    glm::dvec3 center{0.0};              ///< of the box around its shape, m
    std::shared_ptr<const Solid> inside; ///< where no fluid may start; null for a shell
};

/// Each collider of a scene: points all over its surface, collider.spacing particle spacings apart, without those
/// outside the domain. Those of a solid lie `depth` (m) below its surface, as far as it is thick enough. A mesh may be
/// a file of points: a scan. Throws Input for files that cannot be read, colliders of which nothing lies in the domain,
/// and more than `limit` points.
[[nodiscard]] std::vector<ColliderSamples> sample_colliders(const Scene& scene, double depth, std::uint64_t limit);

} // namespace meltpoint
