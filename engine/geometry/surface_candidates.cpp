#include "geometry/surface_candidates.h"

#include "core/parallel_for.h"

namespace meltpoint {

std::vector<glm::vec3> SurfaceCandidates::positions(std::size_t count) const
{
    std::vector<glm::vec3> positions(count);
    parallel_for(count, [&](std::size_t i) { positions[i] = (*this)[i].position; });
    return positions;
}

PointCloud SurfaceCandidates::cloud(std::span<const std::uint32_t> chosen) const
{
    PointCloud cloud = empty_cloud(chosen.size());
    parallel_for(chosen.size(), [&](std::size_t i) { put(cloud, i, chosen[i]); });
    return cloud;
}

PointCloud SurfaceCandidates::cloud(std::size_t count) const
{
    PointCloud cloud = empty_cloud(count);
    parallel_for(count, [&](std::size_t i) { put(cloud, i, i); });
    return cloud;
}

} // namespace meltpoint
