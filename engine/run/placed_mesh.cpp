#include "run/placed_mesh.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "core/log.h"
#include "core/overloaded.h"
#include "geometry/builtin_meshes.h"
#include "geometry/cloud_solid.h"
#include "geometry/mesh_solid.h"
#include "run/load_surface.h"

namespace meltpoint {

namespace {

/// Of what fills `box` in its file.
glm::mat4 placement(const MeshShape& shape, const Aabb& box)
{
    const glm::vec3 extent = box.size();
    const float largest = std::max({extent.x, extent.y, extent.z});
    const float scale = shape.size ? *shape.size / largest : 1.0f;
    glm::mat4 matrix = glm::translate(glm::mat4(1.0f), shape.position);
    matrix = glm::rotate(matrix, glm::radians(shape.rotation.z), glm::vec3(0.0f, 0.0f, 1.0f));
    matrix = glm::rotate(matrix, glm::radians(shape.rotation.y), glm::vec3(0.0f, 1.0f, 0.0f));
    matrix = glm::rotate(matrix, glm::radians(shape.rotation.x), glm::vec3(1.0f, 0.0f, 0.0f));
    matrix = glm::scale(matrix, glm::vec3(scale));
    return glm::translate(matrix, -box.center());
}

TriangleMesh placed(const MeshShape& shape, TriangleMesh mesh)
{
    transform(mesh, placement(shape, bounds(mesh)));
    return mesh;
}

CloudSurface placed(const MeshShape& shape, PointCloud cloud)
{
    Aabb box;
    for (const glm::vec3& x : cloud.positions) {
        box.extend(x);
    }
    const glm::mat4 matrix = placement(shape, box);
    for (glm::vec3& x : cloud.positions) {
        x = glm::vec3(matrix * glm::vec4(x, 1.0f));
    }
    for (glm::vec3& normal : cloud.normals) {
        if (normal != glm::vec3(0.0f)) { // else it is unknown
            normal = glm::normalize(glm::mat3(matrix) * normal);
        }
    }
    CloudSurface surface = make_cloud_surface(std::move(cloud), shape.mesh);
    if (const std::string note = note_of(surface.facts); !note.empty()) {
        log_info(fmt::format("{}: {}", shape.mesh, note));
    }
    return surface;
}

std::variant<TriangleMesh, CloudSurface> placed_surface(const MeshShape& shape)
{
    using Result = std::variant<TriangleMesh, CloudSurface>;
    return std::visit([&](auto loaded) -> Result { return placed(shape, std::move(loaded)); },
                      load_surface(shape.mesh));
}

} // namespace

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

std::variant<TriangleMesh, CloudSurface> placed_surface(const BodyShape& shape)
{
    using Result = std::variant<TriangleMesh, CloudSurface>;
    return std::visit(Overloaded{
                          [](const MeshShape& mesh) { return placed_surface(mesh); },
                          [](const auto& each) -> Result { return placed_mesh(each); },
                      },
                      shape);
}

std::unique_ptr<Solid> solid_in(const std::variant<TriangleMesh, CloudSurface>& surface)
{
    using Result = std::unique_ptr<Solid>;
    return std::visit(Overloaded{
                          [](const TriangleMesh& mesh) -> Result { return std::make_unique<MeshSolid>(weld(mesh)); },
                          [](const CloudSurface& cloud) -> Result { return std::make_unique<CloudSolid>(cloud); },
                      },
                      surface);
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
            [](const MeshShape& mesh) { return solid_in(placed_surface(mesh)); },
        },
        shape);
}

} // namespace meltpoint
