#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/type_precision.hpp>

#include "core/aabb.h"

namespace meltpoint {

/// An indexed triangle mesh. Positions in meters; corners run counterclockwise seen from outside. The mesh need not be
/// closed, nor free of self-intersections.
struct TriangleMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    /// One a vertex, or empty. Of unit length, or zero at a crease, where no single normal describes the surface.
    std::vector<glm::vec3> normals;
    std::vector<glm::u8vec3> colors; ///< sRGB, one a vertex; empty where the source has none
};

/// Throws an Input error that names the mesh unless every later stage can work with it: at least one triangle, indices
/// in range, finite vertices, one normal and one color a vertex or none, an extent between a nanometer and a million
/// kilometers, and an area above zero.
void validate(const TriangleMesh& mesh, std::string_view name);

/// The box of all vertices; empty for a mesh without any.
[[nodiscard]] Aabb bounds(const TriangleMesh& mesh);

/// Area vector of a triangle, (b - a) x (c - a) / 2: its length is the area (m^2), its direction the outward normal.
[[nodiscard]] glm::dvec3 area_vector(const TriangleMesh& mesh, std::size_t triangle);

/// m^2
[[nodiscard]] double triangle_area(const TriangleMesh& mesh, std::size_t triangle);

/// m^2, the sum over all triangles in order.
[[nodiscard]] double surface_area(const TriangleMesh& mesh);

/// Signed volume by the divergence theorem (m^3). The enclosed volume only if the mesh is closed and does not overlap
/// itself: VolumeSamples has the measure that holds for any mesh.
[[nodiscard]] double signed_volume(const TriangleMesh& mesh);

/// Merges vertices that lie within a millionth of the mesh's extent of each other, drops triangles left with fewer than
/// three corners and vertices left without a triangle; both keep their order. Normals of merged vertices are averaged,
/// or set to zero where they differ by more than 30 degrees from their mean (a crease). Their color is that of the
/// first.
[[nodiscard]] TriangleMesh weld(const TriangleMesh& mesh);

/// Normals averaged over the triangles of a vertex, weighted by area.
[[nodiscard]] std::vector<glm::vec3> smooth_normals(const TriangleMesh& mesh);

/// Applies an affine transform to positions and its inverse transpose to normals. A reflection also turns the triangles
/// round, so that outside stays outside.
void transform(TriangleMesh& mesh, const glm::mat4& matrix);

} // namespace meltpoint
