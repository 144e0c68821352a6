#pragma once

#include <cstdint>
#include <string_view>

#include <glm/glm.hpp>

#include "core/image.h"

namespace meltpoint::render {

inline constexpr std::int64_t glyph_height = 9;  ///< pixels at scale 1, two of them below the baseline
inline constexpr std::int64_t glyph_advance = 6; ///< from one character to the next

/// Width of a text in pixels.
[[nodiscard]] std::int64_t text_width(std::string_view text, std::int64_t scale);

/// Writes text with its upper left corner at (x, y), in an 8-bit sRGB color; what lies outside of the picture is cut
/// off. Digits, letters, space and . , - + / ( ) < > % ^ are there; other characters show as a box.
void draw_text(Image& image, std::int64_t x, std::int64_t y, std::string_view text, std::int64_t scale,
               const glm::u8vec3& color);

/// Fills a rectangle, cut off at the picture's edges.
void fill_rectangle(Image& image, std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height,
                    const glm::u8vec3& color);

} // namespace meltpoint::render
