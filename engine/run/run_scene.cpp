#include "run/run_scene.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string_view>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"
#include "core/progress.h"
#include "io/atomic_file.h"
#include "io/image_write.h"
#include "io/particle_export.h"
#include "run/collider_forces.h"
#include "run/frame_painter.h"
#include "run/frame_statistics.h"
#include "run/output_files.h"
#include "run/start_scene.h"
#include "run/video.h"
#include "sim/simulation.h"

namespace meltpoint {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::filesystem::path frame_path(const RunOptions& options, std::uint32_t frame)
{
    return options.out / fmt::format("frame_{:04}.png", frame);
}

std::filesystem::path particles_path(const RunOptions& options, std::uint32_t frame)
{
    return options.out / fmt::format("particles_{:04}.ply", frame);
}

/// Two outputs of one name would replace each other: is that of a table a frame's, or one of the `others`?
void refuse_twins(const Scene& scene, const RunOptions& options, std::string_view option,
                  const std::filesystem::path& table, std::initializer_list<std::filesystem::path> others)
{
    const auto normal = [](const std::filesystem::path& path) {
        return std::filesystem::absolute(path).lexically_normal();
    };
    if (table.empty()) {
        return;
    }
    const std::filesystem::path file = normal(table);
    bool is_taken =
        std::ranges::any_of(others, [&](const auto& other) { return !other.empty() && file == normal(other); });
    if (file.parent_path() == normal(options.out / "any").parent_path()) {
        for (std::uint32_t frame = 0; frame < scene.time.frames && !is_taken; ++frame) {
            is_taken = file.filename() == frame_path(options, frame).filename() ||
                       (options.particles && file.filename() == particles_path(options, frame).filename());
        }
    }
    if (is_taken) {
        throw input_error("{} {}: another output of this run has that name", option, table.string());
    }
}

/// Throws where existing output stands in the way. Changes nothing.
void check_output(const Scene& scene, const RunOptions& options)
{
    refuse_twins(scene, options, "--stats", options.stats, {options.video, options.forces});
    refuse_twins(scene, options, "--forces", options.forces, {options.video});
    if (!options.forces.empty() && scene.colliders.empty()) {
        throw input_error("--forces {}: the scene has no colliders", options.forces.string());
    }
    if (!options.forces.empty() && scene.solver == Solver::Pbf) {
        throw input_error(
            "--forces {}: solver \"pbf\" moves particles and knows no forces on colliders; wcsph and dfsph do",
            options.forces.string());
    }
    for (const std::filesystem::path& file : {options.video, options.stats, options.forces}) {
        if (!file.empty()) {
            refuse_special(file);
        }
    }
    if (options.force) {
        return;
    }
    for (const std::filesystem::path& file : {options.video, options.stats, options.forces}) {
        if (!file.empty()) {
            refuse_existing(file);
        }
    }
    for (std::uint32_t frame = 0; frame < scene.time.frames; ++frame) {
        refuse_existing(frame_path(options, frame));
        if (options.particles) {
            refuse_existing(particles_path(options, frame));
        }
    }
}

void make_folders(const RunOptions& options)
{
    for (const std::filesystem::path& folder :
         {options.out, options.video.parent_path(), options.stats.parent_path(), options.forces.parent_path()}) {
        make_folder(folder);
    }
}

/// Keeps a second run from writing its frames among those of this one. The system lets go of it however a run ends.
class FolderLock {
public:
    explicit FolderLock(const std::filesystem::path& folder)
        : descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
    {
        if (descriptor_ >= 0 && flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            close(descriptor_);
            throw input_error("{}: another run is writing into this folder", folder.string());
        } // file systems without locks have to do without
    }
    ~FolderLock()
    {
        if (descriptor_ >= 0) {
            close(descriptor_);
        }
    }
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    int descriptor_;
};

/// Takes away the frames of an earlier run, some of which this run might leave behind among its own.
void remove_old_frames(const RunOptions& options)
{
    for (const auto& path_of : {frame_path, particles_path}) {
        std::error_code error;
        for (std::uint32_t frame = 0; std::filesystem::remove(path_of(options, frame), error); ++frame) {
        }
    }
}

/// Frames per second of the video: real time where screens can show it; tiny and huge scenes play slower or faster.
double playback_rate(const Scene& scene)
{
    constexpr double screen_rate = 60.0;
    const auto rate = static_cast<double>(scene.time.frame_rate);
    return rate >= 10.0 && rate <= 2.0 * screen_rate ? rate : screen_rate;
}

/// A table of which all so far is written again with every frame, aside and renamed: whatever happens, whole rows
/// remain.
class TableFile {
public:
    TableFile(std::filesystem::path path, std::string_view header) : path_(std::move(path)), text_(header) {}

    void add(std::string_view rows)
    {
        text_ += rows;
        write_file_atomically(path_, std::as_bytes(std::span(text_)));
    }

private:
    std::filesystem::path path_;
    std::string text_;
};

std::string describe_steps(const Scene& scene, const shared::SphParams& params)
{
    const std::string dt = params.adaptive_dt != 0 ? fmt::format("dt at most {:.4g} s", params.longest_dt)
                                                   : fmt::format("dt {:.4g} s", params.dt);
    return scene.solver == Solver::Wcsph ? fmt::format("{}, speed of sound {:.4g} m/s", dt, params.speed_of_sound) : dt;
}

/// Warns of particles that lie on top of each other, once.
double mean_neighbors(sim::Simulation& simulation, std::uint32_t frame, bool& warned_of_coincident)
{
    const sim::NeighborStatistics neighbors = simulation.neighbor_statistics();
    if (neighbors.coincident > 0 && !warned_of_coincident) {
        log_warning(fmt::format("frame {}: {} pairs of particles lie on top of each other and do not push each other "
                                "apart (do fluids overlap?)",
                                frame, neighbors.coincident / 2));
        warned_of_coincident = true;
    }
    return neighbors.mean;
}

/// Warns once of solves that ended before they met their error.
void warn_of_unmet_errors(const Scene& scene,
                          const std::array<sim::Simulation::SolveStatistics, shared::SOLVES>& solves,
                          std::uint32_t frame, bool& warned)
{
    for (std::size_t i = 0; i < solves.size() && !warned; ++i) {
        if (solves[i].unconverged > 0) {
            log_warning(fmt::format("frame {}: {} {} solves ended at {} iterations with errors of up to {:.3g} "
                                    "(solve.max_iterations, solve.{}_error)",
                                    frame, solves[i].unconverged, i == shared::SOLVE_DENSITY ? "density" : "divergence",
                                    scene.solve.max_iterations, solves[i].worst_error,
                                    i == shared::SOLVE_DENSITY ? "density" : "divergence"));
            warned = true;
        }
    }
}

/// The same of viscosity.
void warn_of_unmet_viscosity(const Scene& scene, const sim::Simulation::SolveStatistics& solves, std::uint32_t frame,
                             bool& warned)
{
    if (solves.unconverged > 0 && !warned) {
        log_warning(fmt::format("frame {}: {} viscosity solves ended at {} iterations with errors of up to {:.3g} "
                                "(solve.viscosity_iterations, solve.viscosity_error)",
                                frame, solves.unconverged, scene.solve.viscosity_iterations, solves.worst_error));
        warned = true;
    }
}

/// Warns once of a speed cap that shapes the motion: where it slows down more than a particle of a thousand in a step.
void warn_of_capped_speeds(const Scene& scene, std::uint32_t capped, std::uint64_t particle_steps, std::uint32_t frame,
                           bool& warned)
{
    constexpr double noticeable = 1e-3;
    const double share = capped / std::max(static_cast<double>(particle_steps), 1.0);
    if (share > noticeable && !warned) {
        log_warning(fmt::format("frame {}: {:.2g} % of the particles were slowed down in a step, to {:.4g} spacings "
                                "(pbf.speed_cap; time.dt = \"auto\" takes shorter steps instead)",
                                frame, 100.0 * share, scene.pbf.speed_cap));
        warned = true;
    }
}

/// Warns once of an emitter that has no particles left.
void warn_of_missed_births(const std::vector<std::uint64_t>& missed, std::uint32_t frame, bool& warned)
{
    const auto first = std::ranges::find_if(missed, [](std::uint64_t births) { return births > 0; });
    if (first != missed.end() && !warned) {
        log_warning(fmt::format("frame {0}: emitter.{1} pauses, for all of its particles are out "
                                "(emitter.{1}.particles; what goes into sinks comes back)",
                                frame, first - missed.begin()));
        warned = true;
    }
}

/// What the solves of a frame's steps were like: warned of once where they are not what the scene asks for, and noted.
class Watch {
public:
    explicit Watch(const Scene& scene) : scene_(scene) {}

    /// At a frame's end, so many steps after the last one's.
    void look(sim::Simulation& simulation, std::uint32_t frame, std::uint64_t steps)
    {
        solves_ = simulation.take_solve_statistics();
        viscosity_ = simulation.take_viscosity_statistics();
        if (solves_) {
            warn_of_unmet_errors(scene_, *solves_, frame, warned_of_solves_);
            warn_of_capped_speeds(scene_, (*solves_)[shared::SOLVE_DENSITY].capped,
                                  simulation.particles().count * steps, frame, warned_of_cap_);
        }
        warn_of_missed_births(simulation.missed_births(), frame, warned_of_births_);
        if (viscosity_) {
            warn_of_unmet_viscosity(scene_, *viscosity_, frame, warned_of_viscosity_);
        }
    }

    /// Nothing where there is no simulation.
    void note(std::optional<sim::Simulation>& simulation, const ParticleSet& particles, FrameStatistics& statistics)
    {
        if (simulation) {
            statistics.neighbors_mean = mean_neighbors(*simulation, statistics.frame, warned_of_coincident_);
            const shared::Ledger ledger = simulation->ledger();
            statistics.emitted = ledger.emitted;
            if (const sim::Fragments* fragments = simulation->fragments()) {
                statistics.fragments = fragments->bodies();
            }
            statistics.sunk = ledger.sunk;
            if (simulation->wind() != nullptr && picked_up_ && statistics.time > time_) {
                statistics.rate_wind = (simulation->picked_up() - *picked_up_) / (statistics.time - time_);
            }
            picked_up_ = simulation->picked_up();
            if (has_hydraulic(scene_) || has_sand(scene_)) {
                statistics.deposited = simulation->deposited();
            }
            if (const auto heat = simulation->heat_statistics(particles)) {
                statistics.enthalpy = heat->enthalpy;
                statistics.exposed_area = heat->exposed_area;
            }
        }
        const bool erodes = simulation && simulation->release_time() != nullptr;
        if (erodes && freed_mass_ && statistics.time > time_) {
            const auto rate = [&](std::uint32_t cause) {
                return (statistics.freed_mass[cause] - (*freed_mass_)[cause]) / (statistics.time - time_);
            };
            statistics.rate_melt = rate(shared::CAUSE_MELT);
            statistics.rate_dissolve = rate(shared::CAUSE_FRONT);
            statistics.rate_hydraulic = rate(shared::CAUSE_HYDRAULIC);
        }
        freed_mass_ = statistics.freed_mass;
        time_ = statistics.time;
        if (solves_) {
            statistics.iterations_density = (*solves_)[shared::SOLVE_DENSITY].mean_iterations;
            if (scene_.solver == Solver::Dfsph) {
                statistics.iterations_divergence = (*solves_)[shared::SOLVE_DIVERGENCE].mean_iterations;
            }
        }
        if (viscosity_) {
            statistics.iterations_viscosity = viscosity_->mean_iterations;
        }
    }

private:
    const Scene& scene_;
    std::optional<std::array<sim::Simulation::SolveStatistics, shared::SOLVES>> solves_;
    std::optional<sim::Simulation::SolveStatistics> viscosity_;
    bool warned_of_coincident_ = false;
    bool warned_of_solves_ = false;
    bool warned_of_viscosity_ = false;
    bool warned_of_cap_ = false;
    bool warned_of_births_ = false;
    std::optional<std::array<double, 8>> freed_mass_; ///< kg, at the frame before
    std::optional<double> picked_up_;                 ///< kg, likewise
    double time_ = 0.0;                               ///< s, of it
};

/// s; 0 without steps.
double mean_dt(double seconds, std::uint64_t steps)
{
    return steps > 0 ? seconds / static_cast<double>(steps) : 0.0;
}

} // namespace

RunSummary run_scene(const gpu::Context& context, const Scene& scene, const RunOptions& options)
{
    const Clock::time_point start = Clock::now();
    check_output(scene, options);
    make_folders(options);
    const FolderLock lock(options.out);
    std::optional<VideoWriter> video;
    if (!options.video.empty()) {
        video.emplace(options.video, scene.render.width, scene.render.height, playback_rate(scene));
    }

    StartedScene started = start_scene(context, scene);
    for (const std::string& warning : started.warnings) {
        log_warning(fmt::format("{}: {}", scene.name, warning));
    }
    std::optional<sim::Simulation>& simulation = started.simulation;
    const shared::SphParams& params = started.params;
    const std::uint32_t particle_count = simulation ? simulation->particles().count : 0;
    FramePainter painter(context, scene, params, simulation ? &*simulation : nullptr);
    std::optional<TableFile> statistics_file;
    if (!options.stats.empty()) {
        statistics_file.emplace(options.stats, statistics_header());
    }
    std::optional<TableFile> forces_file;
    if (!options.forces.empty() && simulation) {
        forces_file.emplace(options.forces, forces_header());
        simulation->measure_boundary_forces();
    }
    if (!options.quiet) {
        log_info(fmt::format("{}: {} particles, {}, on {}", scene.name, particle_count, describe_steps(scene, params),
                             context.info().name));
    }

    const auto stopped = [&] {
        return options.stop != nullptr && options.stop->load();
    };
    if (options.force && !stopped()) { // not before all else is known to work: a mistyped scene leaves the old frames
        remove_old_frames(options);
    }
    RunSummary summary{.particles = particle_count};
    Watch watch(scene);
    double previous_frame_time = 0.0;
    Progress progress("frames", scene.time.frames, options.quiet);
    for (std::uint32_t frame = 0; frame < scene.time.frames; ++frame) {
        if (stopped()) {
            summary.stopped = true;
            break;
        }
        const double frame_time = frame / static_cast<double>(scene.time.frame_rate);
        const double time_before = summary.time;
        const std::uint64_t steps_before = summary.steps;
        Clock::time_point clock = Clock::now();
        if (simulation) {
            simulation->advance_by(frame_time - previous_frame_time);
            summary.steps = simulation->step();
            watch.look(*simulation, frame, summary.steps - steps_before);
        }
        summary.time = simulation ? simulation->time() : frame_time;
        previous_frame_time = frame_time;
        const double simulate_ms = milliseconds_since(clock);

        clock = Clock::now();
        const Image image = painter.paint(simulation ? &*simulation : nullptr);
        const double draw_ms = milliseconds_since(clock);
        write_png(frame_path(options, frame), image);
        if (video) {
            video->add(image);
        }
        if (options.particles || statistics_file) {
            const ParticleSet particles = simulation ? simulation->download() : ParticleSet{};
            if (options.particles) {
                write_ply(particles_path(options, frame), particles);
            }
            if (statistics_file) {
                FrameStatistics statistics = measure(particles, params);
                statistics.frame = frame;
                statistics.time = summary.time;
                statistics.steps = summary.steps;
                statistics.dt = mean_dt(summary.time - time_before, summary.steps - steps_before);
                watch.note(simulation, particles, statistics);
                statistics.simulate_ms = simulate_ms;
                statistics.draw_ms = draw_ms;
                statistics_file->add(statistics_row(statistics));
            }
        }
        if (forces_file && simulation) {
            const auto forces = collider_forces(simulation->take_boundary_forces(), started.colliders);
            forces_file->add(forces_rows(frame, summary.time, forces));
        }
        ++summary.frames;
        progress.advance(fmt::format("{:.3f} s", summary.time));
    }
    progress.finish();
    if (video && summary.frames > 0) { // a video of no frames is none
        video->finish();
    }
    summary.seconds = milliseconds_since(start) * 1e-3;
    return summary;
}

} // namespace meltpoint
