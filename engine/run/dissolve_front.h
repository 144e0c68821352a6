#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace meltpoint {

/// When a front reaches each of a solid's particles (m), in s since the start: front.start + max(depth +
/// front.roughness * noise, 0) / front.speed, with the depth below the particle that the front meets first. front.speed
/// must be positive.
[[nodiscard]] std::vector<float> arrival_times(const DissolveFront& front, std::span<const glm::vec3> positions,
                                               std::uint64_t seed);

} // namespace meltpoint
