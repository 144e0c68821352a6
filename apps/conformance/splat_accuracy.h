#pragma once

#include <cstdint>

#include "gpu/context.h"

namespace meltpoint::conformance {

/// How a sphere of splats compares with the true sphere, cast by rays in double precision.
struct SplatAccuracy {
    std::uint32_t splats = 0;
    std::uint32_t pixels = 0;     ///< along each side of the picture
    std::uint32_t inside = 0;     ///< pixels in which the sphere is seen
    std::uint32_t holes = 0;      ///< of these, ones without a splat
    std::uint32_t spill = 0;      ///< pixels outside with a splat
    double normal_error = 0.0;    ///< mean, degrees
    double worst_offset = 0.0;    ///< largest distance of a visible point from the unit sphere
    double expected_offset = 0.0; ///< that of a disc's rim, sqrt(1 + r^2) - 1: nothing stands off farther

    [[nodiscard]] double spill_share() const { return static_cast<double>(spill) / inside; }
};

inline constexpr double spill_bound = 0.003;      ///< of the pixels inside
inline constexpr double normal_error_bound = 1.5; ///< degrees

/// Draws a unit sphere of 20,000 discs on blue-noise (Fibonacci) points at overdraw pi, 512 x 512 pixels of one sample
/// each, and compares every pixel.
[[nodiscard]] SplatAccuracy measure_splats(const gpu::Context& context);

} // namespace meltpoint::conformance
