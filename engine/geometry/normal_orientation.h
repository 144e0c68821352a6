#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "geometry/local_planes.h"

namespace meltpoint {

/// Turns normals to one side of their surface: each takes the sign of a neighbor's, along the minimum spanning tree of
/// the graph of neighbors, in which edges cost 1 - |cosine between the normals| (Hoppe, DeRose, Duchamp, McDonald &
/// Stuetzle 1992, section 3.3). Across edges of a surface that are as sharp as a blade's (40 degrees) it can fail.
///
/// The normals whose `given` is not zero stay as they are, and the tree grows from them. A piece of the graph without
/// any is turned outward: such that the volume which it encloses, by the divergence theorem, is positive. (The highest
/// point with its normal upward, Hoppe's choice, would be decided by a single stray point.) A flat piece looks toward
/// +y, or, where it is vertical, +z or +x. Zero normals stay zero, and connect nothing.
///
/// Returns the number of such pieces. The result does not depend on the number of threads.
std::size_t orient_normals(std::span<const glm::vec3> points, const LocalPlanes& planes,
                           std::span<const std::uint8_t> given, std::vector<glm::vec3>& normals);

} // namespace meltpoint
