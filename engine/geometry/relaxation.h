#pragma once

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "geometry/solid.h"

namespace meltpoint {

/// How far particles in a solid are from an even distribution. Distances in d = cbrt(V / N), densities by the Wendland
/// C2 kernel of support radius 2.6 d, with the space outside of the solid counted as if it were filled.
struct Evenness {
    double density_spread = 0.0;  ///< standard deviation of the density over its mean
    double relative_radius = 0.0; ///< smallest distance over that in the densest packing, 2 cbrt(V / (4 sqrt(2) N))
};

constexpr double relaxed_spread = 0.01;
constexpr double relaxed_radius = 0.71;

struct Relaxation {
    Evenness evenness; ///< in the end
    std::size_t iterations = 0;
};

/// Moves particles in a solid until it is as even as the two constants above say, or 400 times: down the gradient of
/// the density, x += -c d^2 sum_j V grad W(x - x_j), and away from neighbors that are too close. What is outside pushes
/// back like a fluid at rest, so that the outermost particles stay about half a spacing inside, and none leaves. All
/// must be inside at first. The same on any number of threads.
Relaxation relax_particles(std::vector<glm::vec3>& positions, const Solid& solid);

/// Measured without moving anything.
[[nodiscard]] Evenness evenness_of(const std::vector<glm::vec3>& positions, const Solid& solid);

} // namespace meltpoint
