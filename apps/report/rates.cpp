// The report's rates: steps and particle-steps a second.
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/block.h"
#include "bench/measurement.h"
#include "core/log.h"
#include "io/atomic_file.h"
#include "plot/line_plot.h"
#include "report/document.h"
#include "report/sections.h"
#include "run/fluid_settings.h"
#include "run/scene_particles.h"
#include "scene/scene_file.h"

namespace meltpoint::report {

namespace {

std::vector<bench::Result> measure(const Workplace& workplace, const Scene& scene, const ParticleSet& particles,
                                   const std::vector<std::uint32_t>& tiles)
{
    check_stop(workplace);
    log_info(fmt::format("{}: {} particles, 100 steps of warm-up and 70 measured", scene.name, particles.size()));
    return bench::measure(workplace.context, particles, with_fixed_steps(fluid_settings(scene, particles).simulation),
                          {.tiles = tiles});
}

bench::Result measure_scene(const Workplace& workplace, const Scene& scene)
{
    const ParticleSet particles = make_particles(scene, sim::Simulation::particle_limit(workplace.context));
    return measure(workplace, scene, particles, {0}).front();
}

std::string or_dash(const std::optional<double>& value, const char* format)
{
    return value ? fmt::format(fmt::runtime(format), *value) : std::string("-");
}

double millions(double rate)
{
    return rate * 1e-6;
}

std::optional<double> yardstick_rate(const bench::Result& result)
{
    return result.yardstick_step_ms ? std::optional(result.particles / *result.yardstick_step_ms * 1e3) : std::nullopt;
}

std::string how_measured(const Workplace& workplace)
{
    return workplace.context.info().software()
               ? "Times are CPU time over the number of processors; medians of seven portions of 70 steps after 100. "
               : "Times are wall time; medians of seven portions of 70 steps after 100. ";
}

} // namespace

std::string make_table1(const Workplace& workplace)
{
    struct PaperRow {
        const char* scene;
        const char* h;
        const char* dt;
        int frames_per_second; ///< on the four cores of an i7-6700HQ
    };
    constexpr std::array<PaperRow, 3> paper = {
        {{"table1_32k", "1/20", "0.002", 6}, {"table1_16k", "1/16", "0.002", 12}, {"table1_8k", "1/16", "0.0001", 30}}};
    std::vector<Row> rows;
    for (const PaperRow& row : paper) {
        const bench::Result result = measure_scene(workplace, builtin_scene(row.scene));
        rows.push_back({fmt::format("`{}`", row.scene), fmt::format("{}", result.particles), row.h, row.dt,
                        fmt::format("{:.1f}", result.neighbors), fmt::format("{:.0f}", 1e3 / result.step_ms),
                        fmt::format("{}", row.frames_per_second)});
    }
    return table({"scene", "particles", "h, m", "dt, s", "neighbors", "steps/s", "paper, frames/s"}, rows) + "\n" +
           how_measured(workplace) + provenance(workplace);
}

std::string make_dam(const Workplace& workplace)
{
    struct Peer {
        const char* scene;
        double particles;
        double wcsph_ms; ///< a step of SPlisHSPlasH 2.16: AVX2, two threads on two cores, medians of 3
    };
    constexpr std::array<Peer, 5> peers = {{{"benchmark_dam_20", 8000, 5.7},
                                            {"benchmark_dam_25", 15625, 10.3},
                                            {"benchmark_dam", 32768, 22.4},
                                            {"benchmark_dam_40", 64000, 50.6},
                                            {"benchmark_dam_50", 125000, 101.0}}};
    std::vector<Row> rows;
    plot::Curve ours{"Meltpoint", {}};
    plot::Curve loop{"C++ loop", {}};
    plot::Curve theirs{"SPlisHSPlasH", {}};
    for (const Peer& peer : peers) {
        const bench::Result result = measure_scene(workplace, builtin_scene(peer.scene));
        const double peer_rate = peer.particles / peer.wcsph_ms * 1e3;
        const std::optional<double> loop_rate = yardstick_rate(result);
        rows.push_back({fmt::format("`{}`", peer.scene), fmt::format("{}", result.particles),
                        fmt::format("{:.1f}", result.neighbors), fmt::format("{:.2f}", result.step_ms),
                        fmt::format("{:.2f}", millions(result.particle_steps_per_second())),
                        loop_rate ? fmt::format("{:.2f}", millions(*loop_rate)) : "-",
                        fmt::format("{:.2f}", millions(peer_rate)),
                        fmt::format("{:.1f}", result.particle_steps_per_second() / peer_rate)});
        ours.points.emplace_back(result.particles, result.particle_steps_per_second());
        theirs.points.emplace_back(peer.particles, peer_rate);
        if (loop_rate) {
            loop.points.emplace_back(result.particles, *loop_rate);
        }
    }
    const plot::LinePlot rates{.title = "Benchmark dam, WCSPH",
                               .x_label = "particles",
                               .y_label = "particle-steps a second",
                               .curves = {ours, loop, theirs}};
    const std::string svg = to_svg(rates);
    write_file_atomically(workplace.folder / "benchmark_dam.svg", std::as_bytes(std::span(svg)));
    return table({"scene", "particles", "neighbors", "ms a step", "M particle-steps/s", "plain C++ loop",
                  "SPlisHSPlasH", "ratio to it"},
                 rows) +
           fmt::format("\n![rates on the benchmark dam]({}benchmark_dam.svg)\n\n", workplace.link) +
           how_measured(workplace) + provenance(workplace) +
           "\nSPlisHSPlasH 2.16's column: WCSPH at the same spacing, support and step with boundary particles on the "
           "walls, "
           "AVX2, two threads on two\ncores of the same kind of machine as the software device here, measured once.\n";
}

std::string make_block(const Workplace& workplace)
{
    constexpr std::uint32_t particles = 32768;
    const Scene scene = bench::block_scene(particles);
    std::vector<Row> rows;
    for (const bench::Result& result :
         measure(workplace, scene, bench::block_particles(particles, scene.seed), {1, 4, 8})) {
        rows.push_back({fmt::format("{}", result.particles), fmt::format("{}", result.tile),
                        fmt::format("{:.1f}", result.neighbors), fmt::format("{:.2f}", result.step_ms),
                        fmt::format("{:.2f}", millions(result.particle_steps_per_second())),
                        fmt::format("{:.0f}", millions(result.pair_visits_per_second())),
                        or_dash(result.yardstick_step_ms, "{:.2f}"), or_dash(result.speedup(), "{:.2f}")});
    }
    return table({"particles", "tile", "neighbors", "ms a step", "M particle-steps/s", "M pairs/s", "yardstick, ms",
                  "speedup"},
                 rows) +
           "\n" + how_measured(workplace) + provenance(workplace);
}

} // namespace meltpoint::report
