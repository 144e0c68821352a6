#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "core/aabb.h"
#include "geometry/point_cloud.h"
#include "geometry/solid.h"

namespace meltpoint {

/// The points of a solid's surface, moved `depth` (m) inward against their normals: boundary particles push fluid away
/// from where they lie, so a layer of them must lie below the surface for the fluid to end there. Where the solid is
/// thinner than twice the depth, a point goes halfway through; where nothing is inside (a plate), it stays. Along
/// convex edges the points that would come out near the other face are left out, but not on account of faces outside
/// `open`: these meet no fluid. Cloud: positions and normals.
[[nodiscard]] std::vector<glm::vec3> sink_samples(const PointCloud& cloud, const Solid& solid, double depth,
                                                  const Aabb& open);

} // namespace meltpoint
