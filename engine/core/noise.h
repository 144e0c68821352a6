#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace meltpoint {

/// Gradient noise (Perlin, "Improving Noise", 2002) on a lattice of unit cells, with the gradients of a hash of seed
/// and lattice point instead of a table: continuous with two derivatives, zero at lattice points, in [-1, 1].
[[nodiscard]] double gradient_noise(const glm::dvec3& x, std::uint64_t seed);

/// Four octaves of it, each with half the size and half the amplitude of the one before; in [-1, 1].
[[nodiscard]] double fractal_noise(const glm::dvec3& x, std::uint64_t seed);

} // namespace meltpoint
