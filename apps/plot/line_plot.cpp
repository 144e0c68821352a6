#include "plot/line_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "core/error.h"

namespace meltpoint::plot {

namespace {

constexpr double width = 720.0; // pixels
constexpr double height = 420.0;
constexpr double left = 72.0; // of the frame within the picture
constexpr double right = width - 150.0;
constexpr double top = 48.0;
constexpr double bottom = height - 56.0;
constexpr std::size_t most_dots = 20; // of a line; more would hide it
constexpr std::array<const char*, 6> colors = {"#1f6fb4", "#c8552b", "#2f8f5b", "#8a5fb0", "#9a7b1f", "#5b6570"};

/// 1, 2, 5, 10, ...: from the last below the smallest to the first above the largest.
std::vector<double> logarithmic_ticks(double smallest, double largest)
{
    std::vector<double> ticks;
    for (double decade = std::pow(10.0, std::floor(std::log10(smallest)));; decade *= 10.0) {
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double tick = digit * decade;
            if (!ticks.empty() && tick <= smallest * (1.0 + 1e-9)) {
                ticks.clear();
            }
            ticks.push_back(tick);
            if (tick >= largest && ticks.size() > 1) {
                return ticks;
            }
        }
    }
}

/// Four to ten multiples of 1, 2 or 5 times a power of ten, likewise.
std::vector<double> linear_ticks(double smallest, double largest)
{
    // Ticks closer than this would not differ in what is written beside them, or not even as numbers.
    const double least_span = 1e-9 * std::max(std::abs(smallest), std::abs(largest));
    const double span = largest - smallest > least_span ? largest - smallest : std::max(std::abs(largest), 1.0);
    const double decade = std::pow(10.0, std::floor(std::log10(span)));
    const double step = decade * (span > 5.0 * decade ? 1.0 : span > 2.0 * decade ? 0.5 : 0.2);
    const auto first = static_cast<std::int64_t>(std::floor(smallest / step + 1e-9));
    const auto last = std::max(static_cast<std::int64_t>(std::ceil(largest / step - 1e-9)), first + 1);
    std::vector<double> ticks;
    for (std::int64_t k = first; k <= last; ++k) {
        ticks.push_back(static_cast<double>(k) * step);
    }
    return ticks;
}

class Axis {
public:
    Axis(Scale scale, double smallest, double largest, double begin, double end)
        : scale_(scale),
          ticks_(scale == Scale::Linear ? linear_ticks(smallest, largest) : logarithmic_ticks(smallest, largest)),
          begin_(begin), end_(end)
    {
    }

    [[nodiscard]] const std::vector<double>& ticks() const { return ticks_; }
    [[nodiscard]] double place(double value) const
    {
        const auto along = [&](double x) {
            return scale_ == Scale::Linear ? x : std::log(x);
        };
        const double first = along(ticks_.front());
        return begin_ + (end_ - begin_) * (along(value) - first) / (along(ticks_.back()) - first);
    }

private:
    Scale scale_;
    std::vector<double> ticks_;
    double begin_;
    double end_;
};

std::string escaped(const std::string& text)
{
    std::string result;
    for (const char c : text) {
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        default:
            result += c;
        }
    }
    return result;
}

std::string short_number(double value)
{
    return value >= 1e6   ? fmt::format("{:g}M", value * 1e-6)
           : value >= 1e3 ? fmt::format("{:g}k", value * 1e-3)
                          : fmt::format("{:g}", value);
}

std::string text_at(double x, double y, const char* anchor, const std::string& text, const char* more = "")
{
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                       escaped(text));
}

struct Extent {
    double min = std::numeric_limits<double>::infinity();
    double max = -std::numeric_limits<double>::infinity();
    void include(double value)
    {
        min = std::min(min, value);
        max = std::max(max, value);
    }
};

/// Moves labels apart that would cover each other, keeping their order, and within the picture where there is room.
std::vector<double> spread(std::vector<double> wanted)
{
    constexpr double gap = 17.0;
    std::vector<std::size_t> order(wanted.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = i;
    }
    std::ranges::sort(order, {}, [&](std::size_t i) { return wanted[i]; });
    for (std::size_t k = 1; k < order.size(); ++k) {
        wanted[order[k]] = std::max(wanted[order[k]], wanted[order[k - 1]] + gap);
    }
    double lowest = height - 6.0;
    for (std::size_t k = order.size(); k-- > 0; lowest -= gap) {
        wanted[order[k]] = std::min(wanted[order[k]], lowest);
    }
    return wanted;
}

} // namespace

std::string to_svg(const LinePlot& plot)
{
    Extent x_extent;
    Extent y_extent;
    for (const Curve& curve : plot.curves) {
        for (const auto& [x, y] : curve.points) {
            if (!std::isfinite(x) || !std::isfinite(y)) {
                throw input_error("{}: the point ({}, {}) of {} is not finite", plot.title, x, y, curve.name);
            }
            if (plot.scale == Scale::Logarithmic && !(x > 0.0 && y > 0.0)) {
                throw input_error("{}: the point ({}, {}) of {} has no logarithm", plot.title, x, y, curve.name);
            }
            x_extent.include(x);
            y_extent.include(y);
        }
    }
    if (x_extent.min > x_extent.max) {
        throw input_error("{}: there is nothing to plot", plot.title);
    }
    const Axis x_axis(plot.scale, x_extent.min, x_extent.max, left, right);
    const Axis y_axis(plot.scale, y_extent.min, y_extent.max, bottom, top);

    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n"
        "<g stroke=\"#dde2e6\" fill=\"none\">\n",
        width, height);
    for (const double tick : x_axis.ticks()) {
        svg += fmt::format("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\"/>\n", x_axis.place(tick), top, bottom);
    }
    for (const double tick : y_axis.ticks()) {
        svg += fmt::format("<path d=\"M{1:.1f} {0:.1f}H{2:.1f}\"/>\n", y_axis.place(tick), left, right);
    }
    svg += "</g>\n<g fill=\"#333a40\">\n";
    for (const double tick : x_axis.ticks()) {
        svg += text_at(x_axis.place(tick), bottom + 18.0, "middle", short_number(tick));
    }
    for (const double tick : y_axis.ticks()) {
        svg += text_at(left - 8.0, y_axis.place(tick) + 4.0, "end", short_number(tick));
    }
    const double middle = 0.5 * (left + right);
    svg += text_at(middle, top - 20.0, "middle", plot.title, " font-size=\"16\"");
    svg += text_at(middle, bottom + 42.0, "middle", plot.x_label);
    svg += text_at(-0.5 * (top + bottom), 18.0, "middle", plot.y_label, " transform=\"rotate(-90)\"");
    svg += "</g>\n";

    std::vector<double> label_heights;
    for (const Curve& curve : plot.curves) {
        label_heights.push_back(curve.points.empty() ? top : y_axis.place(curve.points.back().second) + 4.0);
    }
    label_heights = spread(label_heights);
    for (std::size_t c = 0; c < plot.curves.size(); ++c) {
        const Curve& curve = plot.curves[c];
        const char* color = colors[c % colors.size()];
        std::string line;
        std::string dots;
        for (const auto& [x, y] : curve.points) {
            const double px = x_axis.place(x);
            const double py = y_axis.place(y);
            line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", px, py);
            dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\"/>\n", px, py);
        }
        svg += fmt::format("<g fill=\"{}\">\n", color);
        if (curve.joined) {
            svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", line, color);
        }
        svg += curve.joined && curve.points.size() > most_dots ? "" : dots;
        svg += text_at(right + 10.0, label_heights[c], "start", curve.name) + "</g>\n";
    }
    return svg + "</svg>\n";
}

} // namespace meltpoint::plot
