#pragma once

#include <span>
#include <string_view>

#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// The names that builtin_mesh knows.
[[nodiscard]] std::span<const std::string_view> builtin_mesh_names();

/// A mesh that needs no file, y up, welded, oriented outward:
///   teapot  the Utah teapot (M. Newell 1975) with its bottom, 6.434 x 3.15 x 4 m, standing on y = 0; open at the spout
///           and around the lid, its handle and spout reaching through the wall of the body
///   rabbit  sitting, looking along x, 2.15 x 2.25 x 1.16 m, standing on y = 0; closed
///   sphere  radius 1 m, around the origin
///   cube    edge 1 m, around the origin, no normals
///   torus   around the y axis: circle of radius 0.4 m on a circle of radius 1 m
///   dune    a barchan for a wind along x, 2.75 x 0.36 x 1.8 m, standing on y = 0, no normals; closed
/// An unknown name is an Input error that offers the nearest known one.
[[nodiscard]] TriangleMesh builtin_mesh(std::string_view name);

} // namespace meltpoint
