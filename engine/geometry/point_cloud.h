#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace meltpoint {

/// Points on the surface of a mesh, one array an attribute, all of the same length.
struct PointCloud {
    std::vector<glm::vec3> positions;    ///< m
    std::vector<glm::vec3> normals;      ///< unit, outward
    std::vector<std::uint32_t> triangle; ///< the triangle that the point lies on
    /// (u, v): the point is a + u (b - a) + v (c - a) on its triangle (a, b, c)
    std::vector<glm::vec2> barycentric;

    [[nodiscard]] std::size_t size() const { return positions.size(); }

    void resize(std::size_t count)
    {
        positions.resize(count);
        normals.resize(count);
        triangle.resize(count);
        barycentric.resize(count);
    }
};

} // namespace meltpoint
