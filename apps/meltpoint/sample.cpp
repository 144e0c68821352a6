#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/error.h"
#include "core/log.h"
#include "core/progress.h"
#include "exit_codes.h"
#include "interrupt.h"
#include "io/point_cloud_export.h"
#include "run/output_files.h"
#include "run/sample_points.h"

namespace meltpoint::program {

namespace {

const std::map<std::string, SurfaceMethod> method_names{{"random", SurfaceMethod::Random},
                                                        {"stratified", SurfaceMethod::Stratified},
                                                        {"blue-noise", SurfaceMethod::BlueNoise}};
const std::map<std::string, Lattice> lattice_names{
    {"cubic", Lattice::Cubic}, {"bcc", Lattice::Bcc}, {"fcc", Lattice::Fcc}, {"blue-noise", Lattice::BlueNoise}};

constexpr std::uint64_t most_seed = 1'000'000'000'000'000'000; // as scenes have it

template <class Value>
std::vector<std::string> names_of(const std::map<std::string, Value>& values)
{
    std::vector<std::string> names;
    for (const auto& [name, value] : values) {
        names.push_back(name);
    }
    return names;
}

struct SampleOptions {
    SampleRequest request;
    std::optional<std::string> method;
    std::string lattice = "cubic";
    std::filesystem::path out;
    std::optional<std::size_t> count;
    std::optional<double> spacing;
    bool json = false;
    bool force = false;
};

/// All that can be said before the work begins.
void check_output(const SampleOptions& options)
{
    check_point_cloud_format(options.out);
    refuse_special(options.out);
    if (!options.force) {
        refuse_existing(options.out);
    }
    refuse_unwritable(options.out);
}

nlohmann::ordered_json json_of(const CloudFacts& facts)
{
    return {{"points", facts.points},
            {"duplicates", facts.duplicates},
            {"normals_given", facts.points - facts.estimated - facts.unknown},
            {"normals_estimated", facts.estimated},
            {"normals_unknown", facts.unknown},
            {"pieces_oriented", facts.pieces}};
}

void print_json(const SampledPoints& points, bool volume)
{
    nlohmann::ordered_json seconds;
    for (const auto& [stage, time] : points.seconds) {
        seconds[stage] = time;
    }
    const std::size_t count = points.cloud.size();
    nlohmann::ordered_json document{{"triangles", points.facts.triangles},
                                    {"boundary_edges", points.facts.boundary_edges},
                                    {"nonmanifold_edges", points.facts.nonmanifold_edges},
                                    {"area", points.facts.area},
                                    {"volume", points.volume.value_or(0.0)},
                                    {"surface_points", volume ? 0 : count},
                                    {"interior_points", volume ? count : 0},
                                    {"spacing", points.spacing},
                                    {"particle_mass", points.particle_mass.value_or(0.0)},
                                    {"seconds", seconds}};
    if (points.cloud_facts) {
        document["cloud"] = json_of(*points.cloud_facts);
    }
    fmt::print("{}\n", document.dump(2));
}

void print_line(const SampleOptions& options, const SampledPoints& points)
{
    double seconds = 0.0;
    for (const auto& [stage, time] : points.seconds) {
        seconds += time;
    }
    const std::string what = options.request.volume
                                 ? fmt::format("{} points of {:.4g} kg in {:.4g} m^3", points.cloud.size(),
                                               points.particle_mass.value_or(0.0), points.volume.value_or(0.0))
                                 : fmt::format("{} points on {:.4g} m^2", points.cloud.size(), points.facts.area);
    fmt::print("{}: {}, {:.4g} m apart, {:.2f} s\n", options.out.string(), what, points.spacing, seconds);
}

int sample(SampleOptions options, bool quiet)
{
    check_output(options);
    SampleRequest& request = options.request;
    if (options.count) {
        request.amount = PointCount{*options.count};
    } else if (options.spacing) {
        request.amount = PointSpacing{*options.spacing};
    }
    if (options.method) {
        request.method = method_names.at(*options.method);
    }
    request.lattice = lattice_names.at(options.lattice);
    request.measure = options.json;
    constexpr std::size_t stages = 4;
    Progress progress("stages", stages, quiet || isatty(STDERR_FILENO) == 0);
    request.on_stage = [&progress](std::string_view stage) {
        if (stage != "normals") { // which only clouds have
            progress.advance(stage);
        }
    };

    SampledPoints points;
    {
        const InterruptGuard at_once(OnInterrupt::Exit); // nothing is written yet
        points = sample_points(request);
    }
    const std::string note = points.cloud_facts ? note_of(*points.cloud_facts) : "";
    if (!note.empty()) {
        log_info(fmt::format("{}: {}", request.source, note));
    }
    const InterruptGuard interrupt(OnInterrupt::Stop);
    make_folder(options.out.parent_path());
    const auto start = std::chrono::steady_clock::now();
    if (!export_point_cloud(options.out, points.cloud, &interrupt.flag())) {
        progress.finish();
        log_warning(fmt::format("interrupted, {} is not written", options.out.string()));
        return exit_interrupted;
    }
    points.seconds.emplace_back("save",
                                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    progress.finish();
    if (options.json) {
        print_json(points, request.volume);
    } else {
        print_line(options, points);
    }
    return exit_done;
}

/// As CLI::Range, but refuses what is not a number and names the bounds in few digits.
CLI::Validator number_in(double low, double high)
{
    const std::string range = fmt::format("[{:g} - {:g}]", low, high);
    return {[=](const std::string& text) {
                double value = 0.0;
                const bool valid = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
                return valid ? std::string() : fmt::format("Value {} not in range {}", text, range);
            },
            "FLOAT in " + range};
}

} // namespace

void add_sample(CLI::App& app, const GlobalOptions& global, int& exit_code)
{
    auto options = std::make_shared<SampleOptions>();
    SampleRequest& request = options->request;
    CLI::App* command = app.add_subcommand("sample", "Turns a mesh or a scan into points, on its surface or inside");
    command
        ->add_option(
            "mesh", request.source,
            "A mesh (.obj, .ply, .stl, .gltf, .glb, .off), points (.ply, .xyz), or builtin:teapot, rabbit, sphere, "
            "cube, torus")
        ->type_name("MESH")
        ->required();
    command->add_option("-o,--out", options->out, "The file to write: .ply, .msh (Gmsh), .vtp (VTK) or .xyz")
        ->type_name("FILE")
        ->required();
    CLI::Option* count =
        command
            ->add_option("--count", options->count,
                         "Number of points, exactly, or, with --volume, within 2 % [100000; of the surface of "
                         "a cloud: its own points]")
            ->type_name("N")
            ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 28));
    command->add_option("--spacing", options->spacing, "Distance between points in m, instead of their number")
        ->type_name("D")
        ->check(number_in(1e-9, 1e9))
        ->excludes(count);
    CLI::Option* volume = command->add_flag("--volume", request.volume, "Points inside, which fill the shape");
    command
        ->add_option("--method", options->method,
                     "How points lie on the surface [random]. Of a cloud too they are new points, on the "
                     "planes through its own")
        ->check(CLI::IsMember(names_of(method_names)))
        ->excludes(volume);
    command->add_option("--lattice", options->lattice, "How points lie inside [cubic]")
        ->check(CLI::IsMember(names_of(lattice_names)))
        ->needs(volume);
    command->add_option("--seed", request.seed, "The same seed gives the same points [1]")
        ->type_name("S")
        ->check(CLI::Range(std::uint64_t{0}, most_seed));
    command->add_option("--rest-density", request.rest_density, "In kg/m^3, for the mass of a particle [1000]")
        ->type_name("R")
        ->check(number_in(1e-6, 1e6));
    command->add_flag("--json", options->json, "Prints all that was measured as JSON, SI units");
    command->add_flag("--force", options->force, "Replaces an existing file");
    command->callback([options, &global, &exit_code] { exit_code = sample(*options, global.quiet); });
}

} // namespace meltpoint::program
