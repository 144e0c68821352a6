#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace meltpoint::report {

/// Points joined by a line, with a name beside its last one.
struct Curve {
    std::string name;
    std::vector<std::pair<double, double>> points; ///< above zero
};

/// Both axes are logarithmic: equal ratios are equal lengths.
struct LinePlot {
    std::string title;
    std::string x_label;
    std::string y_label;
    std::vector<Curve> curves;
};

/// The plot as an SVG picture of its own, legible on light and dark pages. Throws Input when there is no point, or one
/// that a logarithm does not know.
[[nodiscard]] std::string to_svg(const LinePlot& plot);

} // namespace meltpoint::report
