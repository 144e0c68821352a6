#include "geometry/mesh_candidates.h"

#include "core/parallel_for.h"
#include "core/random.h"

namespace meltpoint {

namespace {

std::vector<double> areas_of(const TriangleMesh& mesh)
{
    std::vector<double> areas(mesh.triangles.size());
    parallel_for(areas.size(), [&](std::size_t i) { areas[i] = triangle_area(mesh, i); });
    return areas;
}

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

glm::u8vec3 color_at(const TriangleMesh& mesh, std::uint32_t triangle, double u, double v)
{
    const glm::uvec3& corners = mesh.triangles[triangle];
    const glm::dvec3 a(mesh.colors[corners.x]);
    const glm::dvec3 b(mesh.colors[corners.y]);
    const glm::dvec3 c(mesh.colors[corners.z]);
    return {glm::round((1.0 - u - v) * a + u * b + v * c)};
}

} // namespace

MeshCandidates::MeshCandidates(const TriangleMesh& mesh, std::uint64_t seed)
    : mesh_(mesh), triangles_by_area_(areas_of(mesh)), seed_(seed)
{
}

MeshCandidates::Candidate MeshCandidates::candidate(std::size_t i) const
{
    Random random(seed_, i);
    const std::uint32_t triangle = triangles_by_area_.draw(random);
    double u = random.uniform();
    double v = random.uniform();
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    const glm::uvec3& corners = mesh_.triangles[triangle];
    const glm::dvec3 a(mesh_.positions[corners.x]);
    const glm::dvec3 b(mesh_.positions[corners.y]);
    const glm::dvec3 c(mesh_.positions[corners.z]);
    return {glm::vec3(a + u * (b - a) + v * (c - a)), triangle, glm::vec2(u, v)};
}

SurfaceCandidates::Placed MeshCandidates::operator[](std::size_t i) const
{
    const Candidate chosen = candidate(i);
    return {chosen.position, glm::vec3(glm::normalize(area_vector(mesh_, chosen.triangle)))};
}

PointCloud MeshCandidates::empty_cloud(std::size_t count) const
{
    PointCloud cloud;
    cloud.positions.resize(count);
    cloud.normals.resize(count);
    cloud.triangle.resize(count);
    cloud.barycentric.resize(count);
    cloud.colors.resize(mesh_.colors.empty() ? 0 : count);
    return cloud;
}

void MeshCandidates::put(PointCloud& cloud, std::size_t place, std::size_t number) const
{
    const Candidate chosen = candidate(number);
    cloud.positions[place] = chosen.position;
    cloud.normals[place] = normal_at(mesh_, chosen.triangle, chosen.barycentric.x, chosen.barycentric.y);
    cloud.triangle[place] = chosen.triangle;
    cloud.barycentric[place] = chosen.barycentric;
    if (!cloud.colors.empty()) {
        cloud.colors[place] = color_at(mesh_, chosen.triangle, chosen.barycentric.x, chosen.barycentric.y);
    }
}

} // namespace meltpoint
