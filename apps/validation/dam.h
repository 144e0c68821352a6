#pragma once

#include <cmath>
#include <cstdint>

#include "scene/scene.h"

namespace meltpoint::validation {

/// A column of water let go at one end of a tank, in the units of its experiments.
struct Dam {
    double width = 0.0; ///< of the column, a, m
    Scene scene;

    /// s: T = t / unit is sqrt(2 g / a) t.
    [[nodiscard]] double unit() const { return std::sqrt(width / (2.0 * 9.81)); }
};

/// The column is twice as high as wide and `columns` particles wide, in a tank six times as wide, H = 3 d. depth: of
/// tank and column, into the picture, m; at least two support radii.
[[nodiscard]] Dam make_dam(Solver solver, double width, std::uint32_t columns, double depth);

} // namespace meltpoint::validation
