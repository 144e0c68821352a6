#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "core/error.h"

namespace meltpoint {

inline constexpr std::size_t most_triangles = 50'000'000;

/// Checks the polygons of a file: at least a triangle each, and not too large. Since triangulation takes the square of a
/// polygon's corners, large ones may only be few: a crafted file of nothing else would take hours.
class PolygonCheck {
public:
    explicit PolygonCheck(std::string name) : name_(std::move(name)) {}

    /// Throws Input.
    void operator()(std::size_t corners)
    {
        constexpr std::size_t most_corners = 4096;
        constexpr std::size_t small = 64;                  // corners, up to which the number does not matter
        constexpr std::uint64_t most_work = 1'000'000'000; // squares of corners: some seconds
        if (corners < 3) {
            throw input_error("{}: a face has {} corners, at least 3 are needed", name_, corners);
        }
        if (corners > most_corners) {
            throw input_error("{}: a polygon has {} corners, at most {} are supported", name_, corners, most_corners);
        }
        work_ += corners > small ? std::uint64_t{corners} * corners : 0;
        if (work_ > most_work) {
            throw input_error("{}: there are too many polygons with hundreds of corners: triangulate the mesh first",
                              name_);
        }
    }

private:
    std::string name_;
    std::uint64_t work_ = 0;
};

inline void check_triangles(std::size_t triangles, const std::string& name)
{
    if (triangles > most_triangles) {
        throw input_error("{}: the mesh has {} triangles, at most {} are supported", name, triangles, most_triangles);
    }
}

} // namespace meltpoint
