#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "gpu/context.h"
#include "validation/case.h"

namespace meltpoint::report {

/// Where a section is made.
struct Workplace {
    const gpu::Context& context;
    std::filesystem::path folder; ///< for pictures and plots; exists
    std::string link;             ///< how the document reaches that folder: empty, or a path that ends with a slash
    bool quiet = false;
    const std::atomic<bool>* stop = nullptr; ///< set from outside: throws Interrupted as soon as it can
};

/// A section that was not finished because Workplace::stop was set.
using Interrupted = validation::Interrupted;

/// Throws Interrupted when the workplace's stop is set.
void check_stop(const Workplace& workplace);

/// A section of the report. make() measures or draws, writes its files into the workplace's folder, and returns
/// Markdown.
struct SectionMaker {
    std::string_view name; ///< as in <!-- report:NAME -->
    std::string_view title;
    std::string_view about; ///< for --help
    std::function<std::string(const Workplace&)> make;
};

/// All sections, in the order of a whole report.
[[nodiscard]] std::span<const SectionMaker> section_makers();

/// One sentence in italics: device, driver, processors and commit that a section's numbers come from.
[[nodiscard]] std::string provenance(const Workplace& workplace);

std::string make_gallery(const Workplace& workplace);     ///< pictures of the scenes
std::string make_figures(const Workplace& workplace);     ///< the source paper's figures
std::string make_conformance(const Workplace& workplace); ///< every pass against its twin
std::string make_splats(const Workplace& workplace);      ///< splats against a ray cast
std::string make_sampling(const Workplace& workplace);    ///< seconds to sample
std::string make_table1(const Workplace& workplace);      ///< steps a second on the source paper's table 1
std::string make_dam(const Workplace& workplace);         ///< the benchmark dam, with a plot
std::string make_solvers(const Workplace& workplace);     ///< solvers over the same simulated time
std::string make_block(const Workplace& workplace);       ///< tiles and yardstick on the benchmark's block

/// A flow of which the truth is known, with its plots. Throws Runtime when it is out of its ranges.
std::string make_validation(const Workplace& workplace, const validation::Case& one);

} // namespace meltpoint::report
