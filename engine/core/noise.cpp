#include "core/noise.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace meltpoint {

namespace {

/// A direction of a lattice point, of length 1.
glm::dvec3 gradient_at(const glm::i64vec3& point, std::uint64_t seed)
{
    Random random(seed, static_cast<std::uint64_t>(point.x) * 0x9e3779b97f4a7c15ULL ^
                            static_cast<std::uint64_t>(point.y) * 0xc2b2ae3d27d4eb4fULL ^
                            static_cast<std::uint64_t>(point.z) * 0x165667b19e3779f9ULL);
    const double z = 2.0 * random.uniform() - 1.0;
    const double angle = 6.283185307179586 * random.uniform();
    const double across = std::sqrt(std::max(1.0 - z * z, 0.0));
    return {across * std::cos(angle), across * std::sin(angle), z};
}

} // namespace

double gradient_noise(const glm::dvec3& x, std::uint64_t seed)
{
    const glm::dvec3 corner = glm::floor(x);
    const glm::dvec3 inside = x - corner;
    const glm::dvec3 fade = inside * inside * inside * (inside * (inside * 6.0 - 15.0) + 10.0);
    double sum = 0.0;
    for (int k = 0; k < 8; ++k) {
        const glm::dvec3 step(k & 1, (k >> 1) & 1, k >> 2);
        const glm::dvec3 weight = glm::mix(1.0 - fade, fade, step);
        const glm::dvec3 gradient = gradient_at(glm::i64vec3(corner + step), seed);
        sum += weight.x * weight.y * weight.z * glm::dot(gradient, inside - step);
    }
    // In the middle of a cell all eight gradients may point to it: sqrt(3)/2.
    return std::clamp(sum * 1.1547005383792515, -1.0, 1.0);
}

double fractal_noise(const glm::dvec3& x, std::uint64_t seed)
{
    double sum = 0.0;
    double amplitude = 8.0 / 15.0; // so that all four together make 1
    double frequency = 1.0;
    for (std::uint64_t octave = 0; octave < 4; ++octave) {
        sum += amplitude * gradient_noise(frequency * x, seed * 4 + octave);
        amplitude *= 0.5;
        frequency *= 2.0;
    }
    return sum;
}

} // namespace meltpoint
