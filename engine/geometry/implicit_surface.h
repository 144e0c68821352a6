#pragma once

#include <functional>

#include <glm/glm.hpp>

#include "core/aabb.h"
#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// A function of space (m), below zero inside, that grows about as fast as the distance near its zero.
using ImplicitFunction = std::function<double(const glm::dvec3&)>;

/// The zero of a function within a box, as a closed mesh oriented outward, by naive surface nets (Gibson 1998: one
/// vertex in each cell that the surface crosses, one quad across each crossed edge), its vertices then moved onto the
/// surface and given the gradient as normal. What is thinner than about two cells is lost, and where a saddle crosses
/// all four edges of a face, four triangles share an edge. The function must be above zero on the box's border, or the
/// mesh is open there. `cell` is the edge of a cell, m.
[[nodiscard]] TriangleMesh polygonize(const ImplicitFunction& function, const Aabb& box, double cell);

} // namespace meltpoint
