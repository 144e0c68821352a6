#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "core/aabb.h"
#include "geometry/solid.h"

namespace meltpoint {

/// Nearest neighbors in the densest packing of spheres, in d: 2 cbrt(1 / (4 sqrt(2))), about 1.12.
constexpr double densest_packing = 1.1224620483093730;

constexpr double relaxed_spread = 0.01;
constexpr double relaxed_radius = 0.71;

/// What the particles will meet later on.
struct RelaxationSettings {
    double support_ratio = 2.6;  ///< H/d of the kernel that measures densities, Wendland C2
    std::optional<Aabb> mirrors; ///< m: particles meet their images behind the faces of this box, which contains them
};

/// How far particles in a solid are from an even distribution. Distances in d = cbrt(V / N), densities with the space
/// outside of the solid counted as if it were filled, or with the images behind mirrors.
struct Evenness {
    double density_spread = 0.0;  ///< standard deviation of the density over its mean
    double relative_radius = 0.0; ///< smallest distance over densest_packing d, images left out
};

/// What relax_particles has reached.
struct Relaxation {
    Evenness evenness; ///< in the end
    std::size_t iterations = 0;
};

/// Moves particles in a solid until it is as even as relaxed_spread and relaxed_radius say, or 400 times: down the
/// gradient of the density, x += -c d^2 sum_j V grad W(x - x_j), and away from neighbors that are too close. What is
/// outside pushes back like a fluid at rest, so that the outermost particles stay about half a spacing inside, and none
/// leaves. All must be inside at first. The same on any number of threads.
Relaxation relax_particles(std::vector<glm::vec3>& positions, const Solid& solid,
                           const RelaxationSettings& settings = {});

/// Measured without moving anything.
[[nodiscard]] Evenness evenness_of(const std::vector<glm::vec3>& positions, const Solid& solid,
                                   const RelaxationSettings& settings = {});

} // namespace meltpoint
