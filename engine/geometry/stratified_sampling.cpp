#include "geometry/stratified_sampling.h"

#include <algorithm>

#include <tbb/parallel_sort.h>

#include "core/aabb.h"
#include "core/parallel_for.h"
#include "core/random.h"

namespace meltpoint {

namespace {

constexpr double finest_voxels = 2097152.0;                     // 2^21 along an edge
constexpr std::uint64_t choice_stream = std::uint64_t{1} << 48; // apart from the streams that drew the points

/// The lower 21 bits, two zeros after each.
std::uint64_t spread_bits(std::uint64_t x)
{
    x = (x | x << 32) & 0x001f00000000ffffULL;
    x = (x | x << 16) & 0x001f0000ff0000ffULL;
    x = (x | x << 8) & 0x100f00f00f00f00fULL;
    x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
    return (x | x << 2) & 0x1249249249249249ULL;
}

struct VoxelOfPoint {
    std::uint64_t voxel; ///< number in the order of the octree (Morton 1966)
    std::uint32_t point;

    bool operator<(const VoxelOfPoint& other) const
    {
        return voxel != other.voxel ? voxel < other.voxel : point < other.point;
    }
};

} // namespace

std::vector<std::uint32_t> choose_stratified(std::span<const glm::vec3> points, std::size_t per_stratum,
                                             std::uint64_t seed)
{
    Aabb box;
    for (const glm::vec3& point : points) {
        box.extend(point);
    }
    const glm::dvec3 size(box.size());
    const double scale = finest_voxels / std::max({size.x, size.y, size.z, 1e-300});
    std::vector<VoxelOfPoint> voxels(points.size());
    parallel_for(points.size(), [&](std::size_t i) {
        const glm::dvec3 place = (glm::dvec3(points[i]) - glm::dvec3(box.min)) * scale;
        const glm::u64vec3 voxel(glm::clamp(place, 0.0, finest_voxels - 1.0));
        voxels[i] = {spread_bits(voxel.x) | spread_bits(voxel.y) << 1 | spread_bits(voxel.z) << 2,
                     static_cast<std::uint32_t>(i)};
    });
    tbb::parallel_sort(voxels);

    std::vector<std::uint32_t> chosen(points.size() / per_stratum);
    parallel_for(chosen.size(), [&](std::size_t stratum) {
        Random random(seed, choice_stream + stratum);
        chosen[stratum] = voxels[stratum * per_stratum + random.below(static_cast<std::uint32_t>(per_stratum))].point;
    });
    return chosen;
}

} // namespace meltpoint
