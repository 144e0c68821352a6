#include "run/dust_params.h"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/random.h"

namespace meltpoint {

namespace {

/// A direction of length 1, uniformly distributed.
glm::dvec3 random_direction(Random& random, bool flat)
{
    const double angle = 2.0 * std::numbers::pi * random.uniform();
    const double z = flat ? 0.0 : 2.0 * random.uniform() - 1.0;
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
}

} // namespace

shared::DustParams dust_params(const Scene& scene)
{
    constexpr double finest = 0.25; // of the largest
    const bool flat = scene.domain.dimensions == 2;
    const DustSettings& settings = scene.dust;
    shared::DustParams params{.wind = settings.wind, .response_time = settings.response_time, .life = settings.life};
    params.wind.z = flat ? 0.0f : params.wind.z;
    constexpr std::uint64_t stream = 0x44757374; // of its own, whatever else the seed is for
    Random random(scene.seed, stream);
    double squares = 0.0;
    for (shared::AirWave& wave : params.waves) {
        const double size = static_cast<double>(settings.eddy_size) * std::pow(finest, random.uniform());
        const double number = 2.0 * std::numbers::pi / size;
        const glm::dvec3 along = random_direction(random, flat);
        glm::dvec3 across = flat ? glm::dvec3(-along.y, along.x, 0.0) : glm::dvec3(0.0);
        while (!flat && glm::length(across) < 0.1) { // not along it
            across = glm::cross(along, random_direction(random, false));
        }
        const double amplitude = std::cbrt(size);
        squares += 0.5 * amplitude * amplitude;
        wave.amplitude = amplitude * glm::normalize(across);
        wave.number = number * along;
        wave.phase = static_cast<float>(2.0 * std::numbers::pi * random.uniform());
        // An eddy turns over about once while it goes by itself.
        wave.frequency =
            static_cast<float>(number * static_cast<double>(settings.turbulence) * (random.uniform() - 0.5));
    }
    for (shared::AirWave& wave : params.waves) {
        wave.amplitude *= settings.turbulence / static_cast<float>(std::sqrt(squares));
    }
    return params;
}

} // namespace meltpoint
