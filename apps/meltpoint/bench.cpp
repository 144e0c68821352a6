#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/block.h"
#include "bench/measurement.h"
#include "commands.h"
#include "core/error.h"
#include "core/log.h"
#include "exit_codes.h"
#include "io/atomic_file.h"
#include "run/fluid_settings.h"
#include "run/scene_particles.h"
#include "scene_options.h"

namespace meltpoint::program {

namespace {

struct BenchOptions {
    SceneOptions scene;
    std::vector<std::uint32_t> particles;
    std::vector<std::uint32_t> tiles;
    std::uint32_t steps = 70;
    std::uint32_t warm_up = 100;
    bool own_steps = false;
    std::string json;
};

constexpr std::uint32_t default_particles = 32768;

/// Of its column, which keeps a distance from the one before.
std::size_t pass_width(std::string_view name)
{
    return std::max<std::size_t>(16, name.size() + 2);
}

void print_table(const std::vector<bench::Result>& results)
{
    fmt::print("{:>10}{:>6}{:>11}{:>11}{:>16}{:>15}{:>12}{:>15}{:>9}\n", "particles", "tile", "neighbors", "ms a step",
               "M p-steps/s", "G pairs/s", "bytes a p.", "yardstick, ms", "speedup");
    for (const bench::Result& result : results) {
        const auto or_none = [](const std::optional<double>& value) {
            return value ? fmt::format("{:.3f}", *value) : std::string("-");
        };
        fmt::print("{:>10}{:>6}{:>11.2f}{:>11.3f}{:>16.3f}{:>15.4f}{:>12.0f}{:>15}{:>9}\n", result.particles,
                   result.tile, result.neighbors, result.step_ms, result.particle_steps_per_second() * 1e-6,
                   result.pair_visits_per_second() * 1e-9, static_cast<double>(result.bytes) / result.particles,
                   or_none(result.yardstick_step_ms), or_none(result.speedup()));
    }
    fmt::print("\n{:>10}{:>6}{:>13}{:>18}{:>15}{:>13}\n", "particles", "tile", "dt, ms", "simulated s/s",
               "density error", "iterations");
    for (const bench::Result& result : results) {
        fmt::print("{:>10}{:>6}{:>13.4f}{:>18.5f}{:>15.6f}{:>13.2f}\n", result.particles, result.tile, result.dt * 1e3,
                   result.simulated_seconds_per_second(), result.density_error, result.iterations);
    }
    fmt::print("\nms a pass\n{:>10}{:>6}", "particles", "tile");
    for (const auto& [name, milliseconds] : results.front().passes) {
        fmt::print("{:>{}}", name, pass_width(name));
    }
    fmt::print("\n");
    for (const bench::Result& result : results) {
        fmt::print("{:>10}{:>6}", result.particles, result.tile);
        for (const auto& [name, milliseconds] : result.passes) {
            fmt::print("{:>{}.4f}", milliseconds, pass_width(name));
        }
        fmt::print("\n");
    }
}

nlohmann::ordered_json to_json(const gpu::Context& context, const std::vector<bench::Result>& results)
{
    nlohmann::ordered_json document{{"device", context.info().name},
                                    {"driver", context.info().driver},
                                    {"results", nlohmann::ordered_json::array()}};
    const auto or_null = [](const std::optional<double>& value) {
        return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
    };
    for (const bench::Result& result : results) {
        nlohmann::ordered_json passes = nlohmann::ordered_json::object();
        for (const auto& [name, milliseconds] : result.passes) {
            passes[name] = milliseconds;
        }
        document["results"].push_back({{"particles", result.particles},
                                       {"tile", result.tile},
                                       {"neighbors", result.neighbors},
                                       {"steps", result.steps},
                                       {"step_ms", result.step_ms},
                                       {"dt", result.dt},
                                       {"simulated_s_per_s", result.simulated_seconds_per_second()},
                                       {"density_error_mean", result.density_error},
                                       {"iterations_density", result.iterations},
                                       {"passes", passes},
                                       {"particle_steps_per_s", result.particle_steps_per_second()},
                                       {"pair_visits_per_s", result.pair_visits_per_second()},
                                       {"yardstick_step_ms", or_null(result.yardstick_step_ms)},
                                       {"speedup", or_null(result.speedup())}});
    }
    return document;
}

void measure_particles(const gpu::Context& context, const Scene& scene, const ParticleSet& particles,
                       const bench::Plan& plan, std::vector<bench::Result>& results)
{
    const FluidSettings settings = fluid_settings(scene, particles);
    for (const std::string& warning : settings.warnings) {
        log_warning(warning);
    }
    log_info(fmt::format("{}: {} particles, {} steps of warm-up", scene.name, particles.size(), plan.warm_up));
    for (bench::Result& result : bench::measure(
             context, particles, plan.own_steps ? settings.simulation : with_fixed_steps(settings.simulation), plan)) {
        results.push_back(std::move(result));
    }
}

int run_bench(const BenchOptions& options)
{
    if (!options.scene.scene.empty() && !options.particles.empty()) {
        throw input_error("--particles is for the benchmark's own block: --scene has its particles already");
    }
    if (options.scene.scene.empty() && (!options.scene.overrides.empty() || options.own_steps)) {
        throw input_error("--set and --own-steps are for scenes (--scene): the benchmark's own block is what it is");
    }
    std::optional<AtomicFile> json;
    if (!options.json.empty()) {
        json.emplace(options.json);
    }
    const gpu::Context context(context_options(options.scene));
    const std::uint64_t limit = sim::Simulation::particle_limit(context);
    const bench::Plan plan{.tiles = options.tiles.empty() ? std::vector<std::uint32_t>{0} : options.tiles,
                           .warm_up = options.warm_up,
                           .steps = options.steps,
                           .own_steps = options.own_steps};
    std::vector<bench::Result> results;
    if (!options.scene.scene.empty()) {
        const Scene scene = load_scene(options.scene);
        measure_particles(context, scene, make_particles(scene, limit), plan, results);
    } else {
        for (const std::uint32_t count : options.particles) {
            if (count > limit) {
                throw input_error("--particles {}: {} holds at most {}", count, context.info().name, limit);
            }
        }
        for (const std::uint32_t count :
             options.particles.empty() ? std::vector{default_particles} : options.particles) {
            const Scene scene = bench::block_scene(count);
            measure_particles(context, scene, bench::block_particles(count, scene.seed), plan, results);
        }
    }

    fmt::print("{}, {}\n{}\n", context.info().name, context.info().driver,
               context.info().software() ? "CPU time over the number of processors, medians"
                                         : "wall time; the yardstick: CPU time over the number of processors; medians");
    print_table(results);
    if (json) {
        json->write(to_json(context, results).dump(2) + "\n");
        json->commit();
    }
    require_silent_validation(context);
    return exit_done;
}

} // namespace

void add_bench(CLI::App& app, const GlobalOptions& /*global*/, int& exit_code)
{
    auto options = std::make_shared<BenchOptions>();
    CLI::App* command = app.add_subcommand(
        "bench", "Measures the time step, pass by pass, beside a plain C++ loop of the same algorithm on the CPU");
    command
        ->add_option("--particles", options->particles,
                     "Sizes of the block of fluid that is let go in a box three times as long [32768]")
        ->type_name("N,N,...")
        ->delimiter(',')
        ->check(CLI::Range(bench::fewest_particles, 1u << 30u));
    command
        ->add_option("--steps", options->steps,
                     "Measured steps, in up to seven portions, of which the median counts [70]")
        ->type_name("S")
        ->check(CLI::Range(1u, 1'000'000u));
    command->add_flag("--own-steps", options->own_steps,
                      "Steps as long as the scene has them, chosen by the device where time.dt is auto; no yardstick");
    command->add_option("--warm-up", options->warm_up, "Steps before the measured ones [100]")
        ->type_name("S")
        ->check(CLI::Range(0u, 10'000'000u));
    command->add_option("--tile", options->tiles, "Particles an invocation, 1 to 16, one row each [the device's own]")
        ->type_name("N,N,...")
        ->delimiter(',')
        ->check(CLI::Range(1u, 16u));
    command->add_option("--scene", options->scene.scene, "Measures a scene instead of the block, as render takes it")
        ->type_name("F");
    add_set_option(*command, options->scene);
    add_device_options(*command, options->scene);
    command->add_option("--json", options->json, "Also writes the results, one object a row, to this file")
        ->type_name("F");
    command->callback([options, &exit_code] { exit_code = run_bench(*options); });
}

} // namespace meltpoint::program
