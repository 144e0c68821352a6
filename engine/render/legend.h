#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/image.h"

namespace meltpoint::render {

/// A color bar with ticks: what the colors of a data mode mean.
struct Legend {
    std::string title;                    ///< quantity and unit, as in "speed, m/s"
    glm::vec2 range{0.0f, 1.0f};          ///< values at the ends of the colormap
    std::string below;                    ///< what the color for values below the rest density means; empty: not shown
    glm::vec3 ink{0.03f, 0.035f, 0.045f}; ///< linear RGB of text and ticks
};

/// The legend of a color mode (shared::COLOR_*) over a background of this linear RGB, dark text on light and light on
/// dark. Throws Input for a mode that shows no quantity (material, normal).
[[nodiscard]] Legend legend_for(std::uint32_t color_mode, const glm::vec2& range, const glm::vec3& background);

/// About `wanted` round values (1, 2 or 5 times a power of ten apart) within the range, ascending.
[[nodiscard]] std::vector<double> round_ticks(double low, double high, int wanted);

/// Draws the legend into the lower left corner, larger in larger pictures. A picture too small for it is left as it is.
void draw_legend(Image& image, const Legend& legend);

} // namespace meltpoint::render
