#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace meltpoint {

/// Cuts a simple polygon, convex or not, into corners.size() - 2 triangles of the same orientation, by ear clipping
/// (Meisters 1975), and appends them. Corners index the positions; they may be somewhat out of plane. Polygons that are
/// not simple get as many triangles, of no particular shape. O(n) for each corner that turns inward; fewer than three
/// corners give nothing.
void triangulate_polygon(std::span<const std::uint32_t> corners, const std::vector<glm::vec3>& positions,
                         std::vector<glm::uvec3>& triangles);

} // namespace meltpoint
