#include "report/sections.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "commit.h"
#include "conformance/pass_comparison.h"
#include "conformance/splat_accuracy.h"
#include "core/error.h"
#include "core/log.h"
#include "report/document.h"
#include "run/fluid_settings.h"
#include "run/sample_points.h"
#include "run/scene_particles.h"
#include "scene/scene_file.h"

namespace meltpoint::report {

namespace {

/// The processor's name as Linux gives it, "unknown processor" elsewhere.
std::string processor_name()
{
    std::ifstream file("/proc/cpuinfo");
    std::string line;
    while (std::getline(file, line)) {
        if (line.starts_with("model name")) {
            return line.substr(std::min(line.find(':') + 2, line.size()));
        }
    }
    return "unknown processor";
}

Row error_row(const conformance::PassError& error, const char* state)
{
    return {error.pass, state,
            error.bound > 0.0  ? fmt::format("{:.1e}", error.error)
            : error.conforms() ? "exact"
                               : "wrong",
            error.bound > 0.0 ? fmt::format("{:.0e}", error.bound) : "exact"};
}

} // namespace

void check_stop(const Workplace& workplace)
{
    if (workplace.stop != nullptr && workplace.stop->load()) {
        throw Interrupted{};
    }
}

std::string provenance(const Workplace& workplace)
{
    const gpu::DeviceInfo& device = workplace.context.info();
    return fmt::format("*{}, {}; {} threads of {}; commit {}.*\n", device.name, device.driver,
                       std::thread::hardware_concurrency(), processor_name(), MELTPOINT_COMMIT);
}

std::string make_conformance(const Workplace& workplace)
{
    constexpr std::uint32_t steps = 10;
    const Scene scene = builtin_scene("teapot_floor"); // it has fluid, walls and a collider
    const ParticleSet particles = make_particles(scene, sim::Simulation::particle_limit(workplace.context));
    const sim::SimulationSettings settings = with_fixed_steps(fluid_settings(scene, particles).simulation);
    log_info(fmt::format("{}: {} particles against the CPU reference", scene.name, particles.size()));
    sim::Simulation simulation(workplace.context, particles, settings);
    simulation.advance(steps);

    std::vector<Row> rows;
    bool conforms = true;
    const auto add = [&](const std::vector<conformance::PassError>& errors, const char* state) {
        for (const conformance::PassError& error : errors) {
            rows.push_back(error_row(error, state));
            conforms = conforms && error.conforms();
        }
    };
    add(conformance::compare_passes(workplace.context, simulation.download(), settings), "after 10 steps");
    check_stop(workplace);
    add(conformance::compare_steps(workplace.context, particles, settings, 1), "from the start");
    check_stop(workplace);
    add(conformance::compare_steps(workplace.context, particles, settings, steps), "from the start");
    if (!conforms) {
        throw runtime_error("{} does not agree with the CPU reference: see meltpoint compare {}",
                            workplace.context.info().name, scene.name);
    }
    return table({"pass", "state", "error", "bound"}, rows) +
           fmt::format("\n`{0}`, {1} particles, as `meltpoint compare {0} --steps {2}` finds them. ", scene.name,
                       particles.size(), steps) +
           provenance(workplace);
}

std::string make_splats(const Workplace& workplace)
{
    log_info("splats against a ray cast");
    const conformance::SplatAccuracy accuracy = conformance::measure_splats(workplace.context);
    const std::vector<Row> rows = {{"pixels inside without a splat", fmt::format("{}", accuracy.holes), "0"},
                                   {"spill past the silhouette, of the pixels inside",
                                    fmt::format("{:.2f} %", 100.0 * accuracy.spill_share()),
                                    fmt::format("{:.1f} %", 100.0 * conformance::spill_bound)},
                                   {"mean error of the normal", fmt::format("{:.2f} degrees", accuracy.normal_error),
                                    fmt::format("{:.1f} degrees", conformance::normal_error_bound)}};
    return table({"measured", "value", "bound"}, rows) +
           fmt::format("\nA sphere of {0} discs on Fibonacci points, {1} x {1} pixels. ", accuracy.splats,
                       accuracy.pixels) +
           provenance(workplace);
}

std::string make_sampling(const Workplace& workplace)
{
    struct Task {
        const char* what;
        std::size_t points;
        bool volume = false;
        SurfaceMethod method = SurfaceMethod::Random;
        Lattice lattice = Lattice::Cubic;
    };
    const std::vector<Task> tasks = {
        {.what = "surface, random", .points = 1'000'000},
        {.what = "surface, stratified", .points = 1'000'000, .method = SurfaceMethod::Stratified},
        {.what = "surface, blue noise", .points = 100'000, .method = SurfaceMethod::BlueNoise},
        {.what = "volume, cubic lattice", .points = 1'000'000, .volume = true},
        {.what = "volume, fcc lattice", .points = 1'000'000, .volume = true, .lattice = Lattice::Fcc},
        {.what = "volume, blue noise", .points = 30'000, .volume = true, .lattice = Lattice::BlueNoise}};
    std::vector<Row> rows;
    for (const Task& task : tasks) {
        check_stop(workplace);
        log_info(fmt::format("{}: {} points", task.what, task.points));
        SampleRequest request;
        request.source = "builtin:rabbit";
        request.volume = task.volume;
        request.method = task.method;
        request.lattice = task.lattice;
        request.amount = PointCount{task.points};
        std::array<double, 3> seconds{};
        std::size_t points = 0;
        for (double& total : seconds) {
            const SampledPoints sampled = sample_points(request);
            points = sampled.cloud.size();
            for (const auto& [stage, time] : sampled.seconds) {
                total += time;
            }
        }
        std::ranges::sort(seconds);
        rows.push_back({task.what, fmt::format("{}", points), fmt::format("{:.2f}", seconds[1])});
    }
    return table({"`meltpoint sample builtin:rabbit`", "points", "seconds"}, rows) +
           "\nWall time of loading and sampling, medians of three. " + provenance(workplace);
}

std::span<const SectionMaker> section_makers()
{
    static const std::vector<SectionMaker> makers = [] {
        std::vector<SectionMaker> all = {
            {"gallery", "Pictures", "frames of scenes", make_gallery},
            {"figures", "The source paper's figures", "figures 1 to 6 of the source paper", make_figures},
            {"conformance", "GPU against the CPU reference", "every pass against its twin in double precision",
             make_conformance},
            {"splats", "Splats against a ray cast", "a sphere of splats against the true sphere", make_splats},
            {"sampling", "Sampling", "how long meshes take to sample", make_sampling},
            {"table1", "The source paper's table 1", "steps a second beside the paper's", make_table1},
            {"dam", "The benchmark dam", "particle-steps a second beside other code, with a plot", make_dam},
            {"solvers", "Solvers", "simulated seconds a second, at equal density errors", make_solvers},
            {"block", "The benchmark's block", "tile sizes beside a plain C++ loop", make_block},
        };
        for (const validation::Case& one : validation::cases()) {
            all.push_back({one.name, one.title, "a case of meltpoint validate", [&one](const Workplace& workplace) {
                               return make_validation(workplace, one);
                           }});
        }
        return all;
    }();
    return makers;
}

} // namespace meltpoint::report
