#pragma once

#include <atomic>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/context.h"
#include "plot/line_plot.h"

namespace meltpoint::validation {

/// What a case runs on.
struct Host {
    const gpu::Context& context;
    bool quiet = true;                       ///< shows no progress
    const std::atomic<bool>* stop = nullptr; ///< set from outside: the case throws Interrupted as soon as it can
};

/// A case that was not finished because Host::stop was set.
struct Interrupted {};

void check_stop(const Host& host);

/// A measured number, and the range that it has to lie in.
struct Measurement {
    std::string quantity; ///< with its unit
    double value = 0.0;
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();

    /// What is not a number does not hold.
    [[nodiscard]] bool holds() const { return value >= lowest && value <= highest; }
    /// "at most 0.1", "at least 3", "0.95 to 1.05".
    [[nodiscard]] std::string range() const;
};

[[nodiscard]] Measurement at_most(std::string quantity, double value, double highest);
[[nodiscard]] Measurement at_least(std::string quantity, double value, double lowest);
[[nodiscard]] Measurement within(std::string quantity, double value, double lowest, double highest);

struct Figure {
    std::string file; ///< name of an SVG picture: the case's
    plot::LinePlot plot;
};

struct Outcome {
    std::vector<Measurement> measurements;
    std::vector<Figure> figures;

    [[nodiscard]] bool holds() const;
};

/// A flow of which the truth is known.
struct Case {
    std::string_view name;
    std::string_view title;
    std::string_view about; ///< what is compared with what, and where that comes from
    Outcome (*run)(const Host&);
};

/// All of them, the quicker ones first.
[[nodiscard]] std::span<const Case> cases();

Outcome run_free_fall(const Host& host);
Outcome run_momentum(const Host& host);
Outcome run_poiseuille(const Host& host);
Outcome run_couette(const Host& host);
Outcome run_taylor_green(const Host& host);
Outcome run_column(const Host& host);
Outcome run_still_water(const Host& host);
Outcome run_laplace(const Host& host);
Outcome run_drop(const Host& host);
Outcome run_contact_angle(const Host& host);
Outcome run_buoyancy(const Host& host);
Outcome run_dam_break(const Host& host);
Outcome run_resolution(const Host& host);
Outcome run_water(const Host& host);
Outcome run_honey(const Host& host);

} // namespace meltpoint::validation
