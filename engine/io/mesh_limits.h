#pragma once

#include <cstddef>
#include <string>

#include "core/error.h"

namespace meltpoint {

/// What a mesh file may hold. Triangulation takes the square of a polygon's corners.
inline constexpr std::size_t most_polygon_corners = 4096;
inline constexpr std::size_t most_triangles = 50'000'000;

/// A polygon of a file: at least a triangle, and not too large. Throws Input.
inline void check_corners(std::size_t corners, const std::string& name)
{
    if (corners < 3) {
        throw input_error("{}: a face has {} corners, at least 3 are needed", name, corners);
    }
    if (corners > most_polygon_corners) {
        throw input_error("{}: a polygon has {} corners, at most {} are supported", name, corners,
                          most_polygon_corners);
    }
}

inline void check_triangles(std::size_t triangles, const std::string& name)
{
    if (triangles > most_triangles) {
        throw input_error("{}: the mesh has {} triangles, at most {} are supported", name, triangles, most_triangles);
    }
}

} // namespace meltpoint
