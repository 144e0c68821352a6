#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/error.h"
#include "core/log.h"
#include "core/nearest_name.h"
#include "exit_codes.h"
#include "interrupt.h"
#include "io/atomic_file.h"
#include "run/output_files.h"
#include "scene_options.h"
#include "validation/case.h"

namespace meltpoint::program {

namespace {

struct ValidateOptions {
    SceneOptions scene; ///< for device and validate
    std::vector<std::string> names;
    std::string plots;
    bool json = false;
    bool force = false;
};

std::vector<const validation::Case*> find_cases(const std::vector<std::string>& names)
{
    std::vector<std::string> known;
    for (const validation::Case& one : validation::cases()) {
        known.emplace_back(one.name);
    }
    for (const std::string& name : names) {
        if (std::ranges::find(known, name) == known.end()) {
            const auto nearest = nearest_name(name, known);
            throw input_error("there is no case \"{}\"; {}", name,
                              nearest ? fmt::format("did you mean \"{}\"?", *nearest)
                                      : fmt::format("there are {}", fmt::join(known, ", ")));
        }
    }
    std::vector<const validation::Case*> wanted;
    for (const validation::Case& one : validation::cases()) {
        if (names.empty() || std::ranges::find(names, one.name) != names.end()) {
            wanted.push_back(&one);
        }
    }
    return wanted;
}

void print_outcome(const validation::Case& one, const validation::Outcome& outcome)
{
    fmt::print("{}: {}\n  {:<70}{:>12}  {}\n", one.name, one.title, "measured", "value", "range");
    for (const validation::Measurement& measurement : outcome.measurements) {
        fmt::print("  {:<70}{:>12.4g}  {}{}\n", measurement.quantity, measurement.value, measurement.range(),
                   measurement.holds() ? "" : "  OUT OF RANGE");
    }
    std::fflush(stdout); // the next case takes minutes
}

nlohmann::ordered_json to_json(const validation::Case& one, const validation::Outcome& outcome)
{
    const auto bound = [](double value) {
        return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
    };
    nlohmann::ordered_json result{{"case", one.name},
                                  {"about", one.about},
                                  {"holds", outcome.holds()},
                                  {"measurements", nlohmann::ordered_json::array()},
                                  {"curves", nlohmann::ordered_json::array()}};
    for (const validation::Measurement& measurement : outcome.measurements) {
        result["measurements"].push_back({{"quantity", measurement.quantity},
                                          {"value", measurement.value},
                                          {"lowest", bound(measurement.lowest)},
                                          {"highest", bound(measurement.highest)},
                                          {"holds", measurement.holds()}});
    }
    for (const validation::Figure& figure : outcome.figures) {
        for (const plot::Curve& curve : figure.plot.curves) {
            result["curves"].push_back({{"name", curve.name},
                                        {"x", figure.plot.x_label},
                                        {"y", figure.plot.y_label},
                                        {"points", curve.points}});
        }
    }
    return result;
}

/// Finds out before minutes of work whether there is a place for the plots.
void prepare_plots(const std::filesystem::path& folder, const std::vector<const validation::Case*>& wanted, bool force)
{
    make_folder(folder);
    for (const validation::Case* one : wanted) {
        if (!force) {
            refuse_existing(folder / fmt::format("{}.svg", one->name));
        }
    }
}

void write_plots(const std::filesystem::path& folder, const validation::Outcome& outcome)
{
    for (const validation::Figure& figure : outcome.figures) {
        const std::string svg = plot::to_svg(figure.plot);
        write_file_atomically(folder / figure.file, std::as_bytes(std::span(svg)));
    }
}

int validate(const ValidateOptions& options, bool quiet)
{
    const InterruptGuard interrupt;
    const std::vector<const validation::Case*> wanted = find_cases(options.names);
    if (!options.plots.empty()) {
        prepare_plots(options.plots, wanted, options.force);
    }
    const gpu::Context context(context_options(options.scene));
    const validation::Host host{.context = context, .quiet = quiet, .stop = &interrupt.flag()};
    nlohmann::ordered_json document{{"device", context.info().name},
                                    {"driver", context.info().driver},
                                    {"results", nlohmann::ordered_json::array()}};
    std::size_t held = 0;
    try {
        for (const validation::Case* one : wanted) {
            log_info(fmt::format("{}: {}", one->name, one->about));
            const validation::Outcome outcome = one->run(host);
            held += outcome.holds() ? 1 : 0;
            if (!options.plots.empty()) {
                write_plots(options.plots, outcome);
            }
            if (options.json) {
                document["results"].push_back(to_json(*one, outcome));
            } else {
                print_outcome(*one, outcome);
            }
        }
    } catch (const validation::Interrupted&) {
        return exit_interrupted;
    }
    if (options.json) {
        fmt::print("{}\n", document.dump(2));
    } else {
        fmt::print("{} of {} cases are within their ranges.\n", held, wanted.size());
    }
    require_silent_validation(context);
    return held == wanted.size() ? exit_done : exit_failed;
}

} // namespace

void add_validate(CLI::App& app, const GlobalOptions& global, int& exit_code)
{
    auto options = std::make_shared<ValidateOptions>();
    std::string about =
        "Runs flows of which the truth is known, and compares: exit code 1 where a number is out of its "
        "range. It takes minutes a case. Cases:";
    for (const validation::Case& one : validation::cases()) {
        about += fmt::format("\n  {:<12} {}", one.name, one.title);
    }
    CLI::App* command = app.add_subcommand("validate", about);
    command->add_option("CASE", options->names, "Cases by name [all]")->type_name("NAME");
    command->add_option("--plots", options->plots, "Also draws what was measured, as SVG files in this folder")
        ->type_name("DIR");
    command->add_flag("--json", options->json, "Prints the result as JSON, with the curves' points");
    command->add_flag("--force", options->force, "Replaces existing plots");
    add_device_options(*command, options->scene);
    command->callback([options, &global, &exit_code] { exit_code = validate(*options, global.quiet); });
}

} // namespace meltpoint::program
