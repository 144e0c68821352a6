#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/type_precision.hpp>

namespace meltpoint {

/// Points on a surface, sampled from a mesh or scanned: one array an attribute, each either empty or as long as
/// `positions`.
struct PointCloud {
    std::vector<glm::vec3> positions; ///< m
    std::vector<glm::vec3> normals;   ///< unit, outward; zero where one is unknown. Empty for scans without
    /// the triangle that the point lies on; empty for scans
    std::vector<std::uint32_t> triangle;
    /// (u, v): the point is a + u (b - a) + v (c - a) on its triangle (a, b, c); empty for scans
    std::vector<glm::vec2> barycentric;
    std::vector<glm::u8vec3> colors; ///< sRGB; empty where the source has none
    bool intensity_ignored = false;  ///< its file tells one of every point, which is left out

    [[nodiscard]] std::size_t size() const { return positions.size(); } ///< points
};

} // namespace meltpoint
