// The report's comparison of solvers.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/pace.h"
#include "core/log.h"
#include "report/document.h"
#include "report/sections.h"
#include "run/fluid_settings.h"
#include "run/scene_particles.h"
#include "scene/scene_file.h"

namespace meltpoint::report {

namespace {

constexpr const char* scene_name = "benchmark_dam_20";
constexpr double seconds = 1.5; // the collapse, and the wave's return

struct Run {
    std::string what;
    bench::Pace pace;
};

Run run(const Workplace& workplace, const std::string& what, std::vector<std::string> changes)
{
    check_stop(workplace);
    changes.emplace_back("time.dt=auto");
    const Scene scene = builtin_scene(scene_name, changes);
    log_info(fmt::format("{}: {}", scene_name, what));
    const ParticleSet particles = make_particles(scene, sim::Simulation::particle_limit(workplace.context));
    return {what,
            bench::measure_pace(workplace.context, particles, fluid_settings(scene, particles).simulation, seconds)};
}

Run run_wcsph(const Workplace& workplace, double speed_of_sound)
{
    return run(workplace, fmt::format("wcsph, c0 = {:.3g} m/s", speed_of_sound),
               {"solver=wcsph", fmt::format("physics.speed_of_sound={}", speed_of_sound)});
}

/// wcsph with the speed of sound at which it is compressed as `other` is, or with the scene's where that is enough.
/// Compression goes with about 1/c0^2: a power law through the last two runs finds it.
Run run_wcsph_as(const Workplace& workplace, const Run& other)
{
    constexpr int most_runs = 4;
    constexpr double close_enough = 0.1;
    double speed = static_cast<double>(builtin_scene(scene_name).physics.speed_of_sound.value());
    double exponent = -2.0;
    Run last = run_wcsph(workplace, speed);
    for (int i = 1; i < most_runs; ++i) {
        const double wanted = other.pace.density_error / last.pace.density_error;
        if (std::abs(wanted - 1.0) < close_enough || (i == 1 && wanted > 1.0)) {
            break;
        }
        const double next_speed = speed * std::pow(wanted, 1.0 / exponent);
        const Run next = run_wcsph(workplace, next_speed);
        exponent = std::log(next.pace.density_error / last.pace.density_error) / std::log(next_speed / speed);
        speed = next_speed;
        last = next;
    }
    return last;
}

Row row(const Run& run, const Run& beside)
{
    const double ratio = run.pace.simulated_seconds_per_second / beside.pace.simulated_seconds_per_second;
    return {run.what,
            fmt::format("{:.3f} %", 100.0 * run.pace.density_error),
            fmt::format("{:.2f}", 1e3 * run.pace.dt),
            run.pace.iterations > 0.0 ? fmt::format("{:.1f}", run.pace.iterations) : "-",
            fmt::format("{:.3f}", run.pace.simulated_seconds_per_second),
            &run == &beside ? "1" : fmt::format("{:.1f}", ratio)};
}

} // namespace

std::string make_solvers(const Workplace& workplace)
{
    std::vector<Row> rows;
    for (const std::string solver : {"dfsph", "pbf"}) {
        const Run solved = run(workplace, solver, {"solver=" + solver});
        const Run wcsph = run_wcsph_as(workplace, solved);
        rows.push_back(row(solved, wcsph));
        rows.push_back(row(wcsph, wcsph));
    }
    return table({"solver", "mean density error", "mean step, ms", "iterations", "simulated s/s", "ratio"}, rows) +
           fmt::format("\n`{}` with steps of the solver's own, its first {:g} s. ", scene_name, seconds) +
           (workplace.context.info().software() ? "Times are CPU time over the number of processors. "
                                                : "Times are wall time. ") +
           provenance(workplace);
}

} // namespace meltpoint::report
