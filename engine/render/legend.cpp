#include "render/legend.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/color.h"
#include "core/error.h"
#include "render/bitmap_font.h"
#include "shared/colormap.h"
#include "shared/render_params.h"

namespace meltpoint::render {

namespace {

constexpr std::uint32_t cap_height = 7; // of the font's capitals and digits

/// 8-bit sRGB of linear RGB.
glm::u8vec3 encode(const glm::vec3& linear)
{
    glm::u8vec3 encoded;
    for (int i = 0; i < 3; ++i) {
        encoded[i] = color_byte(255.0 * srgb_from_linear(static_cast<double>(linear[i])));
    }
    return encoded;
}

float luminance(const glm::vec3& linear)
{
    return glm::dot(linear, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

} // namespace

Legend legend_for(std::uint32_t color_mode, const glm::vec2& range, const glm::vec3& background)
{
    Legend legend;
    legend.range = range;
    if (luminance(background) < 0.18f) {
        legend.ink = glm::vec3(0.85f);
    }
    switch (color_mode) {
    case shared::COLOR_DENSITY:
        legend.title = "density, kg/m^3";
        legend.below = "< rest density";
        break;
    case shared::COLOR_SPEED:
        legend.title = "speed, m/s";
        break;
    case shared::COLOR_PRESSURE:
        legend.title = "pressure, Pa";
        break;
    default:
        throw input_error("color mode {} shows no quantity and has no legend", color_mode);
    }
    return legend;
}

std::vector<double> round_ticks(double low, double high, int wanted)
{
    std::vector<double> ticks;
    if (!(std::abs(high - low) > 0.0) || !std::isfinite(high - low) || wanted < 1) {
        return ticks;
    }
    const auto [first, last] = std::minmax(low, high);
    const double raw = (last - first) / wanted;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    double step = 10.0 * power;
    for (const double factor : {5.0, 2.0, 1.0}) {
        step = factor * power >= raw * 0.999 ? factor * power : step;
    }
    const double slack = 1e-9 * (last - first) / step; // ends that are round themselves belong to the ticks
    const double begin = std::ceil(first / step - slack);
    const int count = static_cast<int>(std::floor(last / step + slack) - begin) + 1;
    for (int i = 0; i < count; ++i) {
        ticks.push_back((begin + i) * step + 0.0); // never "-0"
    }
    return ticks;
}

void draw_legend(Image& image, const Legend& legend)
{
    const std::int64_t scale = std::max(image.height / 360u, 1u);
    const std::int64_t margin = 10 * scale;
    const std::int64_t bar_width = 150 * scale;
    const std::int64_t bar_height = 8 * scale;
    const std::int64_t line = (glyph_height + 2) * scale;
    const std::int64_t swatch = legend.below.empty() ? 0 : line + 2 * scale;
    if (image.width < bar_width + 2 * margin || image.height < 2 * margin + bar_height + 2 * line + swatch) {
        return;
    }
    const glm::u8vec3 ink = encode(legend.ink);
    const std::int64_t left = margin;
    const std::int64_t bar_top = image.height - margin - line - bar_height;

    for (std::int64_t x = 0; x < bar_width; ++x) {
        const float t = (static_cast<float>(x) + 0.5f) / static_cast<float>(bar_width);
        fill_rectangle(image, left + x, bar_top, 1, bar_height, encode(shared::colormap(t)));
    }
    draw_text(image, left, bar_top - line, legend.title, scale, ink);

    const double span = static_cast<double>(legend.range.y) - legend.range.x;
    for (const double tick : round_ticks(legend.range.x, legend.range.y, 4)) {
        const std::int64_t x = left + std::llround((tick - legend.range.x) / span * static_cast<double>(bar_width));
        fill_rectangle(image, x - scale / 2, bar_top + bar_height, scale, 2 * scale, ink);
        const std::string label = fmt::format("{:g}", tick);
        const std::int64_t at = std::max(x - text_width(label, scale) / 2, scale);
        draw_text(image, at, bar_top + bar_height + 3 * scale, label, scale, ink);
    }
    if (!legend.below.empty()) {
        const std::int64_t top = bar_top - line - swatch;
        fill_rectangle(image, left, top, bar_height, cap_height * scale, encode(shared::below_rest_color()));
        draw_text(image, left + bar_height + 4 * scale, top, legend.below, scale, ink);
    }
}

} // namespace meltpoint::render
