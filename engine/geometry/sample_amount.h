#pragma once

#include <cstddef>
#include <variant>

namespace meltpoint {

/// How many points to take.
struct PointCount {
    std::size_t points = 0;
};

/// How far apart points should be: each stands for an area of meters^2, or a volume of meters^3.
struct PointSpacing {
    double meters = 0.0;
};

using SampleAmount = std::variant<PointCount, PointSpacing>;

} // namespace meltpoint
