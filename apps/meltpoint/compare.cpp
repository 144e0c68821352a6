#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "conformance/pass_comparison.h"
#include "core/log.h"
#include "exit_codes.h"
#include "run/fluid_settings.h"
#include "run/scene_particles.h"
#include "scene_options.h"

namespace meltpoint::program {

namespace {

struct CompareOptions {
    SceneOptions scene;
    std::uint32_t steps = 50;
    bool json = false;
};

struct Section {
    std::string name;
    std::vector<conformance::PassError> errors;
};

bool conforms(const std::vector<Section>& sections)
{
    return std::all_of(sections.begin(), sections.end(), [](const Section& section) {
        return std::all_of(section.errors.begin(), section.errors.end(),
                           [](const conformance::PassError& error) { return error.conforms(); });
    });
}

void print_table(const std::vector<Section>& sections)
{
    for (const Section& section : sections) {
        fmt::print("{}\n  {:<28}{:>12}{:>12}{:>12}\n", section.name, "pass", "error", "bound", "excluded");
        for (const conformance::PassError& error : section.errors) {
            fmt::print("  {:<28}{:>12.3g}{:>12.3g}{:>12}  {}\n", error.pass, error.error, error.bound, error.excluded,
                       error.conforms() ? "ok" : "BEYOND THE BOUND");
        }
    }
    fmt::print("{}\n", conforms(sections) ? "The device agrees with the CPU reference."
                                          : "The device does NOT agree with the CPU reference.");
}

void print_json(const std::vector<Section>& sections, const gpu::Context& context, std::size_t particles,
                std::uint32_t steps)
{
    nlohmann::ordered_json document{{"device", context.info().name},  {"driver", context.info().driver},
                                    {"particles", particles},         {"steps", steps},
                                    {"conforms", conforms(sections)}, {"results", nlohmann::ordered_json::array()}};
    for (const Section& section : sections) {
        for (const conformance::PassError& error : section.errors) {
            document["results"].push_back({{"state", section.name},
                                           {"pass", error.pass},
                                           {"error", error.error},
                                           {"bound", error.bound},
                                           {"excluded", error.excluded},
                                           {"conforms", error.conforms()}});
        }
    }
    fmt::print("{}\n", document.dump(2));
}

int compare(const CompareOptions& options)
{
    const Scene scene = load_scene(options.scene);
    const gpu::Context context(context_options(options.scene));
    const ParticleSet initial = make_particles(scene, sim::Simulation::particle_limit(context));
    const FluidSettings settings = fluid_settings(scene, initial);
    for (const std::string& warning : settings.warnings) {
        log_warning(warning);
    }
    log_info(fmt::format("{}: {} particles on {}, against the CPU reference in double precision", scene.name,
                         initial.size(), context.info().name));

    std::vector<Section> sections;
    sim::SimulationSettings fixed = with_fixed_steps(settings.simulation); // the twin takes no others
    fixed.emission = {}; // and knows only those who are there, and neither heat nor erosion
    fixed.melting.reset();
    fixed.hydraulic.reset();
    fixed.wind.reset();
    sections.push_back({"initial state", conformance::compare_passes(context, initial, fixed)});
    if (options.steps > 0) {
        sim::Simulation simulation(context, initial, fixed);
        simulation.advance(options.steps);
        sections.push_back({fmt::format("after {} steps", options.steps),
                            conformance::compare_passes(context, simulation.download(), fixed)});
        sections.push_back({"whole steps", conformance::compare_steps(context, initial, fixed, 1)});
        if (options.steps > 1) {
            for (conformance::PassError& error : conformance::compare_steps(context, initial, fixed, options.steps)) {
                sections.back().errors.push_back(std::move(error));
            }
        }
    }
    if (options.json) {
        print_json(sections, context, initial.size(), options.steps);
    } else {
        print_table(sections);
    }
    require_silent_validation(context);
    return conforms(sections) ? exit_done : exit_failed;
}

} // namespace

void add_compare(CLI::App& app, const GlobalOptions& /*global*/, int& exit_code)
{
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command = app.add_subcommand(
        "compare", "Runs a scene's passes on the device and in the CPU reference side by side; exit code "
                   "1 where an error lies beyond its bound");
    add_scene_options(*command, options->scene);
    command->add_option("--steps", options->steps, "Time steps on both sides [50]")
        ->type_name("N")
        ->check(CLI::Range(0u, 100'000u));
    command->add_flag("--json", options->json, "Prints the result as JSON");
    command->callback([options, &exit_code] { exit_code = compare(*options); });
}

} // namespace meltpoint::program
