#pragma once

#include <cstdint>

namespace meltpoint {

/// How far off a plane layer of boundary particles the first layer of a lattice of fluid is at rest density, in
/// spacings: where sum_b V_b W, V_b = 1 / sum_k W_bk (Akinci et al. 2012), equals what the missing layers of the
/// lattice would add. One spacing at small support radii; wider kernels see the layer as thicker. support_ratio: H/d.
/// In two dimensions layers are lines.
[[nodiscard]] double boundary_distance(std::uint32_t kernel, double support_ratio, std::uint32_t dimensions = 3);

} // namespace meltpoint
