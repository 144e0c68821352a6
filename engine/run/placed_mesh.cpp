#include "run/placed_mesh.h"

#include <algorithm>
#include <array>

#include <glm/gtc/matrix_transform.hpp>

#include "core/overloaded.h"
#include "geometry/builtin_meshes.h"
#include "geometry/mesh_solid.h"
#include "run/load_mesh.h"

namespace meltpoint {

TriangleMesh placed_mesh(const MeshShape& shape)
{
    TriangleMesh mesh = load_mesh(shape.mesh);
    const Aabb box = bounds(mesh);
    const glm::vec3 extent = box.size();
    const float largest = std::max({extent.x, extent.y, extent.z});
    const float scale = shape.size ? *shape.size / largest : 1.0f;
    glm::mat4 matrix = glm::translate(glm::mat4(1.0f), shape.position);
    matrix = glm::rotate(matrix, glm::radians(shape.rotation.z), glm::vec3(0.0f, 0.0f, 1.0f));
    matrix = glm::rotate(matrix, glm::radians(shape.rotation.y), glm::vec3(0.0f, 1.0f, 0.0f));
    matrix = glm::rotate(matrix, glm::radians(shape.rotation.x), glm::vec3(1.0f, 0.0f, 0.0f));
    matrix = glm::scale(matrix, glm::vec3(scale));
    matrix = glm::translate(matrix, -box.center());
    transform(mesh, matrix);
    return mesh;
}

TriangleMesh placed_mesh(const BlockShape& shape)
{
    const glm::vec3 extent = shape.max - shape.min;
    TriangleMesh mesh = builtin_mesh("cube");
    glm::mat4 matrix = glm::translate(glm::mat4(1.0f), 0.5f * (shape.min + shape.max));
    for (int axis = 0; axis < 3; ++axis) {
        if (extent[axis] == 0.0f) { // only the face above is left
            std::erase_if(mesh.triangles, [&](const glm::uvec3& corners) {
                return mesh.positions[corners.x][axis] < 0.0f || mesh.positions[corners.y][axis] < 0.0f ||
                       mesh.positions[corners.z][axis] < 0.0f;
            });
            for (glm::vec3& position : mesh.positions) {
                position[axis] = 0.0f;
            }
        }
    }
    transform(mesh, glm::scale(matrix, glm::max(extent, glm::vec3(1e-30f))));
    return mesh;
}

TriangleMesh placed_mesh(const SphereShape& shape)
{
    TriangleMesh mesh = builtin_mesh("sphere");
    transform(mesh, glm::scale(glm::translate(glm::mat4(1.0f), shape.center), glm::vec3(shape.radius)));
    return mesh;
}

std::unique_ptr<Solid> placed_solid(const BodyShape& shape)
{
    using Result = std::unique_ptr<Solid>;
    return std::visit(
        Overloaded{
            [](const BlockShape& block) -> Result {
                return std::make_unique<BoxSolid>(Aabb{block.min, block.max});
            },
            [](const SphereShape& ball) -> Result { return std::make_unique<BallSolid>(ball.center, ball.radius); },
            [](const MeshShape& mesh) -> Result { return std::make_unique<MeshSolid>(weld(placed_mesh(mesh))); },
        },
        shape);
}

} // namespace meltpoint
