#pragma once

#include <memory>
#include <variant>

#include "geometry/cloud_surface.h"
#include "geometry/solid.h"
#include "geometry/triangle_mesh.h"
#include "scene/scene.h"

namespace meltpoint {

/// The surface of a block. Flat along one axis, it is a plate: a single face.
[[nodiscard]] TriangleMesh placed_mesh(const BlockShape& shape);

[[nodiscard]] TriangleMesh placed_mesh(const SphereShape& shape);

/// The surface of a shape. A mesh, which may be a file of points (load_surface), is scaled to its size, turned about
/// the center of its bounding box, which is put in its place. What points were given that their file does not say is
/// told by log_info. Throws Input as load_surface and make_cloud_surface do.
[[nodiscard]] std::variant<TriangleMesh, CloudSurface> placed_surface(const BodyShape& shape);

/// What is inside of a mesh or of a cloud of points.
[[nodiscard]] std::unique_ptr<Solid> solid_in(const std::variant<TriangleMesh, CloudSurface>& surface);

/// What is inside a shape. Notes and errors as placed_surface.
[[nodiscard]] std::unique_ptr<Solid> placed_solid(const BodyShape& shape);

} // namespace meltpoint
