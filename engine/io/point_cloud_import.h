#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "geometry/point_cloud.h"

namespace meltpoint {

/// Whether a file's bytes, as if they stood at `path`, are points rather than a mesh: .xyz, or .ply whose header tells
/// of no faces. Errors as import_point_cloud.
[[nodiscard]] bool holds_points(std::span<const std::uint8_t> bytes, const std::filesystem::path& path);

/// Reads a cloud of points: .ply (read_ply), or .xyz, which has three, six or nine numbers a line, x y z [nx ny nz]
/// [r g b], parted by blanks, commas or semicolons, comments from # or // on. Six numbers are positions and colors
/// where the last three are whole, from 0 to 255 and of no unit length; of four, the last is an intensity, which is
/// ignored. Before the points may stand the names of the columns, x y z first, and then their number, which must be
/// right. Normals get unit length; those that are zero or not finite are zero, and none at all if every one is. A file
/// that is missing, unreadable, broken or cut off, that has no points, or coordinates not finite or beyond a million
/// kilometers is an Input error that names file and reason.
[[nodiscard]] PointCloud import_point_cloud(const std::filesystem::path& path);

/// The same of a file's bytes, as if they stood at `path`.
[[nodiscard]] PointCloud parse_point_cloud(std::span<const std::uint8_t> bytes, const std::filesystem::path& path);

} // namespace meltpoint
