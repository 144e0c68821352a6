#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "geometry/cloud_cells.h"
#include "geometry/point_cloud.h"

namespace meltpoint {

/// What was found in a cloud, and what was done to it.
struct CloudFacts {
    std::size_t points = 0;         ///< in different places
    std::size_t duplicates = 0;     ///< dropped: points where another one is
    std::size_t estimated = 0;      ///< normals that were missing and are estimated
    std::size_t pieces = 0;         ///< of the surface that got their outside by themselves, not from given normals
    std::size_t unknown = 0;        ///< points without a normal in the end: they lie on a line with all their neighbors
    bool intensity_ignored = false; ///< as the cloud has it
};

/// What was done to a cloud that its file does not say, for a person; empty where nothing was.
[[nodiscard]] std::string note_of(const CloudFacts& facts);

/// A cloud of points as a surface.
struct CloudSurface {
    PointCloud cloud;  ///< with normals, zero where they are unknown
    CloudCells cells;  ///< one a point
    double area = 0.0; ///< m^2, of all cells
    CloudFacts facts;
};

/// Makes a surface of a cloud. Of points in the same place the first stays, with the first normal among theirs. Normals
/// that are given stay as they are; where there is none, or one of length zero, it is estimated (LocalPlanes) and
/// turned outward (orient_normals). Memory and time stay in proportion to the points.
/// The same on any number of threads.
///
/// An Input error, which names the cloud: fewer than three points in different places, all of them on a line, more than
/// ten million, an extent of less than a nanometer.
[[nodiscard]] CloudSurface make_cloud_surface(PointCloud cloud, std::string_view name);

} // namespace meltpoint
