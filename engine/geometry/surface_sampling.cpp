#include "geometry/surface_sampling.h"

#include "core/error.h"
#include "core/parallel_for.h"
#include "core/random.h"
#include "geometry/alias_table.h"

namespace meltpoint {

namespace {

constexpr std::size_t most_points = std::size_t{1} << 28;

glm::vec3 normal_at(const TriangleMesh& mesh, std::uint32_t triangle, double u, double v)
{
    if (!mesh.normals.empty()) {
        const glm::uvec3& corners = mesh.triangles[triangle];
        const glm::dvec3 a(mesh.normals[corners.x]);
        const glm::dvec3 b(mesh.normals[corners.y]);
        const glm::dvec3 c(mesh.normals[corners.z]);
        const glm::dvec3 normal = (1.0 - u - v) * a + u * b + v * c;
        const bool all_there = glm::dot(a, a) > 0.0 && glm::dot(b, b) > 0.0 && glm::dot(c, c) > 0.0;
        if (all_there && glm::length(normal) > 0.1) {
            return glm::vec3(glm::normalize(normal));
        }
    }
    return glm::vec3(glm::normalize(area_vector(mesh, triangle)));
}

} // namespace

PointCloud sample_surface_random(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed)
{
    if (count > most_points) {
        throw input_error("{} surface samples were asked for, at most {} are supported", count, most_points);
    }
    std::vector<double> areas(mesh.triangles.size());
    parallel_for(areas.size(), [&](std::size_t i) { areas[i] = triangle_area(mesh, i); });
    const AliasTable triangles_by_area(areas);

    PointCloud cloud;
    cloud.resize(count);
    parallel_for(count, [&](std::size_t i) {
        Random random(seed, i);
        const std::uint32_t triangle = triangles_by_area.draw(random);
        double u = random.uniform();
        double v = random.uniform();
        if (u + v > 1.0) {
            u = 1.0 - u;
            v = 1.0 - v;
        }
        const glm::uvec3& corners = mesh.triangles[triangle];
        const glm::dvec3 a(mesh.positions[corners.x]);
        const glm::dvec3 b(mesh.positions[corners.y]);
        const glm::dvec3 c(mesh.positions[corners.z]);
        cloud.positions[i] = glm::vec3(a + u * (b - a) + v * (c - a));
        cloud.normals[i] = normal_at(mesh, triangle, u, v);
        cloud.triangle[i] = triangle;
        cloud.barycentric[i] = glm::vec2(u, v);
    });
    return cloud;
}

} // namespace meltpoint
