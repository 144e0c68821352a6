#pragma once

#include "geometry/triangle_mesh.h"

namespace meltpoint::test {

/// A box around the origin, black where x < 0 and white beyond; the change takes a tenth of its length.
inline TriangleMesh black_and_white_box(const glm::vec3& size)
{
    TriangleMesh mesh;
    for (const float x : {-0.5f, -0.05f, 0.05f, 0.5f}) {
        for (const glm::vec2 corner : {glm::vec2(-0.5f), {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}}) {
            mesh.positions.push_back(size * glm::vec3(x, corner));
            mesh.colors.emplace_back(static_cast<std::uint8_t>(x < 0.0f ? 0 : 255));
        }
    }
    for (std::uint32_t section = 0; section < 3; ++section) {
        for (std::uint32_t side = 0; side < 4; ++side) {
            const std::uint32_t a = 4 * section + side;
            const std::uint32_t b = 4 * section + (side + 1) % 4;
            mesh.triangles.push_back({a, b, a + 4});
            mesh.triangles.push_back({b, b + 4, a + 4});
        }
    }
    mesh.triangles.insert(mesh.triangles.end(), {{0, 2, 1}, {0, 3, 2}, {12, 13, 14}, {12, 14, 15}});
    return mesh;
}

} // namespace meltpoint::test
