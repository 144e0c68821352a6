#pragma once

#include <memory>

#include "geometry/solid.h"
#include "geometry/triangle_mesh.h"
#include "scene/scene.h"

namespace meltpoint {

/// A mesh scaled to its size, turned about its center, its center put in its place. Throws Input as load_mesh does.
[[nodiscard]] TriangleMesh placed_mesh(const MeshShape& shape);

/// The surface of a block. Flat along one axis, it is a plate: a single face.
[[nodiscard]] TriangleMesh placed_mesh(const BlockShape& shape);

[[nodiscard]] TriangleMesh placed_mesh(const SphereShape& shape);

/// What is inside a shape. Throws Input as load_mesh does.
[[nodiscard]] std::unique_ptr<Solid> placed_solid(const BodyShape& shape);

} // namespace meltpoint
