#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace meltpoint::plot {

/// Points, with a name beside the last one.
struct Curve {
    std::string name;
    std::vector<std::pair<double, double>> points; ///< above zero where axes are logarithmic
    bool joined = true;                            ///< by a line
};

enum class Scale { Logarithmic, Linear }; ///< logarithmic: equal ratios are equal lengths

/// Both axes have the same scale.
struct LinePlot {
    std::string title;
    std::string x_label;
    std::string y_label;
    std::vector<Curve> curves;
    Scale scale = Scale::Logarithmic;
};

/// The plot as an SVG picture of its own, legible on light and dark pages. Throws Input when there is no point, one
/// that is not finite, or one that a logarithm does not know.
[[nodiscard]] std::string to_svg(const LinePlot& plot);

} // namespace meltpoint::plot
