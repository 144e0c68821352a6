#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace meltpoint {

/// The light of an sRGB value, both from 0 to 1 (IEC 61966-2-1).
[[nodiscard]] inline double linear_from_srgb(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// The sRGB value of light, both from 0 to 1.
[[nodiscard]] inline double srgb_from_linear(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// The nearest whole number from 0 to 255; 0 of what is not a number.
[[nodiscard]] inline std::uint8_t color_byte(double value)
{
    return value > 0.0 ? static_cast<std::uint8_t>(std::lround(std::min(value, 255.0))) : std::uint8_t{0};
}

} // namespace meltpoint
