#pragma once

#include <atomic>
#include <filesystem>

#include "geometry/point_cloud.h"

namespace meltpoint {

/// Throws an Input error unless the path ends as one of the formats that export_point_cloud writes.
void check_point_cloud_format(const std::filesystem::path& path);

/// Writes a cloud of points, whole or not at all (atomic_file.h), in the format that the path ends in:
///   .ply  binary little-endian: x y z, nx ny nz, red green blue, triangle, u v
///   .msh  Gmsh 2.2, binary: each point a node with a point element, the normals as a view
///   .vtp  VTK XML PolyData, raw appended data: each point a vertex cell; Normals, Colors, triangle, barycentric
///   .xyz  a line a point: x y z [nx ny nz] [r g b]
/// Attributes that the cloud lacks are left out. Lengths in m, numbers with all their digits, in the order of the
/// cloud. Returns false, with the path as it was, where `stop` became true in the meantime. Throws Error: Input for
/// another format, Runtime when the file cannot be written or an attribute is shorter or longer than the cloud.
bool export_point_cloud(const std::filesystem::path& path, const PointCloud& cloud,
                        const std::atomic<bool>* stop = nullptr);

} // namespace meltpoint
