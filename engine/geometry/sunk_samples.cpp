#include "geometry/sunk_samples.h"

#include <algorithm>
#include <cstdint>

#include "core/parallel_for.h"
#include "geometry/point_cells.h"

namespace meltpoint {

namespace {

// Of the depth that a point has sunk: nearer than this to another face it is left out. Its own face is one depth away.
constexpr double least_cover = 0.75;

/// How deep a point may go, in quarters of `depth`: half the way that is inside.
double sunk_depth(const glm::dvec3& x, const glm::dvec3& inward, const Solid& solid, double depth)
{
    constexpr int probes = 4;
    int inside = 0;
    while (inside < probes && solid.contains(x + inward * (2.0 * depth * (inside + 1) / probes))) {
        ++inside;
    }
    return depth * inside / probes;
}

} // namespace

std::vector<glm::vec3> sink_samples(const PointCloud& cloud, const Solid& solid, double depth, const Aabb& open)
{
    const std::size_t count = cloud.size();
    std::vector<glm::vec3> sunk(count);
    std::vector<std::uint8_t> kept(count, 1);
    const PointCells cells(cloud.positions, depth);
    parallel_for(count, [&](std::size_t i) {
        const glm::dvec3 x(cloud.positions[i]);
        const glm::dvec3 inward = -glm::dvec3(cloud.normals[i]);
        const bool knows_inside = glm::dot(inward, inward) > 0.0;
        const double own_depth = knows_inside ? sunk_depth(x, inward, solid, depth) : 0.0;
        const glm::dvec3 place = x + own_depth * inward;
        sunk[i] = glm::vec3(place);
        cells.visit_near(place, [&](std::uint32_t at) {
            const glm::vec3& other = cloud.positions[cells.order()[at]];
            if (open.contains(other) && glm::distance(glm::dvec3(other), place) < least_cover * own_depth) {
                kept[i] = 0;
            }
        });
    });
    std::size_t left = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (kept[i] != 0) {
            sunk[left++] = sunk[i];
        }
    }
    sunk.resize(left);
    return sunk;
}

} // namespace meltpoint
