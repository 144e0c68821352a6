#include "geometry/cloud_candidates.h"

#include "core/random.h"
#include "geometry/tangent_frame.h"

namespace meltpoint {

namespace {

/// Uniform in a convex polygon around the origin: in one of the triangles from there to its edges.
glm::dvec2 place_in(std::span<const glm::vec2> corners, double area, Random& random)
{
    const auto corner = [&](std::size_t i) {
        return glm::dvec2(corners[i % corners.size()]);
    };
    double left = 2.0 * area * random.uniform();
    std::size_t edge = 0;
    for (; edge + 1 < corners.size(); ++edge) {
        const double triangle = cross(corner(edge), corner(edge + 1));
        if (left < triangle) {
            break;
        }
        left -= triangle;
    }
    double u = random.uniform();
    double v = random.uniform();
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return u * corner(edge) + v * corner(edge + 1);
}

} // namespace

CloudCandidates::CloudCandidates(const CloudSurface& surface, std::uint64_t seed)
    : surface_(surface), points_by_area_(surface.cells.areas()), seed_(seed)
{
}

CloudCandidates::Candidate CloudCandidates::candidate(std::size_t i) const
{
    Random random(seed_, i);
    const std::uint32_t point = points_by_area_.draw(random);
    const glm::dvec2 place = place_in(surface_.cells.corners(point), surface_.cells.areas()[point], random);
    const TangentFrame frame(glm::dvec3(surface_.cloud.normals[point]));
    return {glm::vec3(glm::dvec3(surface_.cloud.positions[point]) + place.x * frame.u + place.y * frame.v), point};
}

SurfaceCandidates::Placed CloudCandidates::operator[](std::size_t i) const
{
    const Candidate chosen = candidate(i);
    return {chosen.position, surface_.cloud.normals[chosen.point]};
}

PointCloud CloudCandidates::empty_cloud(std::size_t count) const
{
    PointCloud cloud;
    cloud.positions.resize(count);
    cloud.normals.resize(count);
    cloud.colors.resize(surface_.cloud.colors.empty() ? 0 : count);
    return cloud;
}

void CloudCandidates::put(PointCloud& cloud, std::size_t place, std::size_t number) const
{
    const Candidate chosen = candidate(number);
    cloud.positions[place] = chosen.position;
    cloud.normals[place] = surface_.cloud.normals[chosen.point];
    if (!cloud.colors.empty()) {
        cloud.colors[place] = surface_.cloud.colors[chosen.point];
    }
}

} // namespace meltpoint
