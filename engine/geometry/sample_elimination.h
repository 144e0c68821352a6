#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace meltpoint {

/// How many candidates to give sample elimination. With the paper's five a sample the relative radius ends at 0.69,
/// with seven at 0.72, with twelve, at four times the time, at 0.75 (measured on a sphere); corners and edges take some
/// off.
[[nodiscard]] constexpr std::size_t elimination_candidates(std::size_t samples)
{
    return samples * (samples <= 10'000 ? 12 : 7);
}

struct EliminationInput {
    std::span<const glm::vec3> points; ///< uniformly distributed candidates (m)
    /// Unit, one a candidate, or empty. Points whose normals are more than 134 degrees apart lie on different sides of
    /// something thin: they do not see each other.
    std::span<const glm::vec3> normals;
    std::size_t keep = 0; ///< how many to leave
    double spacing = 0.0; ///< 2 r_max, m: no set of so many points could have all of them that far apart
    /// Where only some candidates, by their number, count as kept and are returned. It is asked once `look_at`
    /// candidates are left, for these only, from several threads.
    std::function<bool(std::uint32_t)> counts;
    std::size_t look_at = 0;
};

/// Weighted sample elimination (Yuksel 2015, "Sample elimination for generating Poisson disk sample sets"): takes the
/// candidate with the most and nearest neighbors away until `keep` are left. alpha 8, beta 0.65, gamma 1.5. Returns
/// their numbers, ascending.
[[nodiscard]] std::vector<std::uint32_t> eliminate_samples(const EliminationInput& input);

} // namespace meltpoint
