#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reference/state.h"
#include "shared/visibility.h"

namespace meltpoint::reference {

/// Twin of sim/visibility_depth.comp: the depth map, width * height texels.
[[nodiscard]] std::vector<std::uint32_t> depth_map(const shared::VisibilityParams& params, const State& state);

/// Twin of include/visibility.glsl: how much of a point (m) on a surface with that unit normal is seen, 0 to 1. What
/// lies beside the map is seen.
[[nodiscard]] double visibility(const shared::VisibilityParams& params, std::span<const std::uint32_t> map,
                                const glm::dvec3& x, const glm::dvec3& normal);

/// Twin of sim/visibility_query.comp: of every solid particle that is exposed (reference/exposure.h), 0 of all others.
[[nodiscard]] std::vector<double> visibility_of_solids(const shared::VisibilityParams& params,
                                                       std::span<const std::uint32_t> map, const State& state,
                                                       std::span<const glm::dvec4> exposure);

} // namespace meltpoint::reference
