#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace meltpoint {

/// One in `per_stratum` of the points, whose number must be a multiple of it: the numbers of the chosen points, in the
/// order of the strata.
///
/// After Nehab & Shilane 2004, "Stratified point sampling of 3D models": many points are sorted into voxels, and one is
/// kept in each. Voxels cut a surface into pieces of unequal area, by its direction up to sqrt(3); here runs of
/// `per_stratum` points in the order of the voxels of an octree are the strata, which have the same area but for the
/// chance of the points themselves. So every point is as likely to be chosen as any other.
[[nodiscard]] std::vector<std::uint32_t> choose_stratified(std::span<const glm::vec3> points, std::size_t per_stratum,
                                                           std::uint64_t seed);

} // namespace meltpoint
