#pragma once

#include <memory>
#include <variant>

#include "geometry/cloud_surface.h"
#include "geometry/solid.h"
#include "geometry/triangle_mesh.h"
#include "scene/scene.h"

namespace meltpoint {

/// A mesh scaled to its size, turned about its center, its center put in its place. Throws Input as load_mesh does.
[[nodiscard]] TriangleMesh placed_mesh(const MeshShape& shape);

/// The surface of a block. Flat along one axis, it is a plate: a single face.
[[nodiscard]] TriangleMesh placed_mesh(const BlockShape& shape);

[[nodiscard]] TriangleMesh placed_mesh(const SphereShape& shape);

/// The surface of a shape; that of a mesh may be a file of points (load_surface), placed by their bounding box. Throws
/// Input as load_surface and make_cloud_surface do.
[[nodiscard]] std::variant<TriangleMesh, CloudSurface> placed_surface(const BodyShape& shape);

/// What is inside a shape of meshes only. Throws Input as load_mesh does.
[[nodiscard]] std::unique_ptr<Solid> placed_solid(const BodyShape& shape);

} // namespace meltpoint
