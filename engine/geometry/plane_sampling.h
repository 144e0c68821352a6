#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "geometry/volume_sampling.h"

namespace meltpoint {

/// Shapes in the plane z = 0, filled with square lattices or outlined. Volumes are areas, m^2.

/// Fills a rectangle exactly: each axis gets the whole number of particles nearest to its length / spacing, the first
/// half a step inside. `spacing` of the result is the square root of area / N. Throws Input where the spacing is not
/// positive, a side is shorter than half of it, or there would be more than 2^28 points.
[[nodiscard]] VolumeSamples sample_rectangle(const glm::vec2& min, const glm::vec2& max, double spacing);

/// Fills a disk with a square lattice whose spacing is chosen within 2.5 %, and which is shifted, until
/// |N d^2 / area - 1| <= 0.2 % or, of so few particles, as near as the search gets. Errors as above.
[[nodiscard]] VolumeSamples sample_disk(const glm::vec2& center, double radius, double spacing);

/// Points on the outline of a rectangle at most `spacing` apart, its corners among them; where it is flat, along the
/// line that it is.
[[nodiscard]] std::vector<glm::vec3> outline_rectangle(const glm::vec2& min, const glm::vec2& max, double spacing);

/// Points on a circle at most `spacing` apart, at least three.
[[nodiscard]] std::vector<glm::vec3> outline_disk(const glm::vec2& center, double radius, double spacing);

} // namespace meltpoint
