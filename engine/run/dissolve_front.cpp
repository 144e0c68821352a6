#include "run/dissolve_front.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "core/noise.h"
#include "core/parallel_for.h"

namespace meltpoint {

std::vector<float> arrival_times(const DissolveFront& front, std::span<const glm::vec3> positions, std::uint64_t seed)
{
    const glm::dvec3 along = glm::normalize(glm::dvec3(front.direction.value_or(glm::vec3(0.0f, -1.0f, 0.0f))));
    std::vector<double> way(positions.size());
    parallel_for(positions.size(), [&](std::size_t i) {
        const glm::dvec3 x(positions[i]);
        way[i] = front.point ? glm::distance(x, glm::dvec3(*front.point)) : glm::dot(x, along);
    });
    const double entry = positions.empty() ? 0.0 : *std::ranges::min_element(way);
    std::vector<float> times(positions.size());
    parallel_for(positions.size(), [&](std::size_t i) {
        const double unevenness = fractal_noise(glm::dvec3(positions[i]) / static_cast<double>(front.grain), seed);
        const double depth = way[i] - entry + static_cast<double>(front.roughness) * unevenness;
        times[i] = front.start + static_cast<float>(std::max(depth, 0.0) / static_cast<double>(front.speed));
    });
    return times;
}

} // namespace meltpoint
