#include "validation/column.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace meltpoint::validation {

namespace {

constexpr double height = 1.0;                         // h, m
constexpr double gravity = static_cast<double>(9.81f); // as the device has it
constexpr double rest_density = 1000.0;                // kg/m^3
const double speed_of_sound = 10.0 * std::sqrt(gravity * height);

Scene column_scene(const ColumnSettings& settings)
{
    const double spacing = height / settings.layers;
    const auto width = static_cast<float>(settings.width * spacing);
    Scene scene;
    scene.name = fmt::format("column {}", settings.layers);
    scene.solver = settings.solver;
    scene.domain.min = glm::vec3(0.0f);
    scene.domain.max = glm::vec3(width, static_cast<float>(height + 6.0 * spacing), width);
    scene.domain.dimensions = settings.dimensions;
    scene.particles.spacing = static_cast<float>(spacing);
    scene.particles.support_ratio = settings.support_ratio;
    scene.physics.gravity.y = static_cast<float>(-settings.gravity_factor * gravity);
    scene.physics.speed_of_sound = static_cast<float>(speed_of_sound);
    FluidBody fluid{.shape = BlockShape{glm::vec3(0.0f), glm::vec3(width, static_cast<float>(height), width)}};
    fluid.viscosity = settings.viscosity;
    scene.fluids.push_back(fluid);
    return scene;
}

/// g h/c0^2 of what can be compressed.
double compression(const ColumnSettings& settings)
{
    return settings.solver == Solver::Wcsph ? gravity * height / (speed_of_sound * speed_of_sound) : 0.0;
}

double mean(const std::vector<double>& values, std::size_t begin, std::size_t end)
{
    return std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(begin),
                           values.begin() + static_cast<std::ptrdiff_t>(end), 0.0) /
           static_cast<double>(end - begin);
}

/// By layer: y/h, and p/(rho g h).
std::vector<std::pair<double, double>> by_layer(const std::vector<double>& y, const std::vector<double>& pressure)
{
    constexpr std::size_t slices = 40;
    std::vector<std::pair<double, double>> sum(slices);
    std::vector<double> count(slices);
    for (std::size_t i = 0; i < y.size(); ++i) {
        const auto slice = std::min(slices - 1, static_cast<std::size_t>(std::max(0.0, y[i] / height * slices)));
        sum[slice].first += y[i] / height;
        sum[slice].second += pressure[i] / (rest_density * gravity * height);
        count[slice] += 1.0;
    }
    std::vector<std::pair<double, double>> means;
    for (std::size_t slice = 0; slice < slices; ++slice) {
        if (count[slice] > 0.0) {
            means.emplace_back(sum[slice].first / count[slice], sum[slice].second / count[slice]);
        }
    }
    return means;
}

} // namespace

double ColumnProfile::largest_energy() const
{
    return *std::ranges::max_element(energy);
}

double ColumnProfile::trend() const
{
    const std::size_t count = energy.size();
    constexpr double rest = 1e-6;
    const std::size_t last_quarter = count - count / 4;
    return std::max(mean(energy, last_quarter, count), rest) / std::max(mean(energy, count / 2, last_quarter), rest);
}

StillColumn::StillColumn(const Host& host, const ColumnSettings& settings)
    : host_(host), settings_(settings), scene_(column_scene(settings)),
      set_(make_particles(scene_, sim::Simulation::particle_limit(host.context)))
{
}

void StillColumn::settle()
{
    for (int round = 0; round < 10; ++round) {
        run(height / speed_of_sound);
        std::ranges::fill(set_.velocity, glm::vec3(0.0f));
    }
}

void StillColumn::run(double seconds)
{
    check_stop(host_);
    sim::Simulation simulation(host_.context, set_, fluid_settings(scene_, set_).simulation);
    simulation.advance_by(seconds);
    set_ = simulation.download();
}

ColumnProfile StillColumn::profile(double seconds, std::uint32_t samples, std::uint32_t looks)
{
    std::vector<double> y(set_.size());
    std::vector<double> pressure(set_.size());
    ColumnProfile result;
    const std::uint32_t all_looks = samples * looks;
    SceneRun run(host_, scene_, set_, all_looks);
    for (std::uint32_t look = 1; look <= all_looks; ++look) {
        run.advance_by(seconds / all_looks);
        const ParticleSet& set = run.particles();
        for (std::size_t k = 0; k < set.size(); ++k) {
            y[k] += static_cast<double>(set.position[k].y) / all_looks;
            pressure[k] += static_cast<double>(set.pressure[k]) / all_looks;
        }
        if (look % looks == 0) {
            const FrameStatistics& statistics = run.statistics();
            result.energy.push_back(statistics.kinetic_energy / (statistics.mass * gravity * height));
        }
    }
    set_ = run.particles();
    const double surface = height * (1.0 - 0.5 * compression(settings_));
    double error = 0.0;
    double exact_squared = 0.0;
    for (std::size_t k = 0; k < set_.size(); ++k) {
        const double exact = rest_density * gravity * std::max(0.0, surface - y[k]);
        error += std::pow(pressure[k] - exact, 2);
        exact_squared += exact * exact;
    }
    result.pressure_error = std::sqrt(error / exact_squared);
    const double exact_depth = height * (1.0 - 2.0 / 3.0 * compression(settings_));
    result.depth = 2.0 * mean(y, 0, y.size()) / exact_depth;
    result.pressure = by_layer(y, pressure);
    return result;
}

Outcome run_column(const Host& host)
{
    Outcome outcome;
    plot::LinePlot plot{.title = "Water at rest: its pressure",
                        .x_label = "y / h",
                        .y_label = "p / (rho g h)",
                        .curves = {{"rho g (h - y)", {{0.0, 1.0}, {1.0, 0.0}}}},
                        .scale = plot::Scale::Linear};
    for (const ColumnSettings& settings :
         {ColumnSettings{.layers = 40, .dimensions = 2}, ColumnSettings{.layers = 80, .dimensions = 2},
          ColumnSettings{.layers = 160, .dimensions = 2}, ColumnSettings{.layers = 40}, ColumnSettings{.layers = 80}}) {
        StillColumn column(host, settings);
        column.settle();
        const ColumnProfile profile = column.profile(2.0, 100);
        const std::string name = fmt::format("{}D, h = {} d", settings.dimensions, settings.layers);
        outcome.measurements.push_back(at_most(name + ": pressure, L2 of its error", profile.pressure_error, 0.03));
        outcome.measurements.push_back(
            within(name + ": depth, of that of compressed water", profile.depth, 0.99, 1.01));
        outcome.measurements.push_back(
            at_most(name + ": kinetic energy, most, of rho g h V", profile.largest_energy(), 1e-4));
        plot.curves.push_back({name, profile.pressure, false});
    }
    outcome.figures.push_back({"column.svg", plot});
    return outcome;
}

ColumnProfile measure_still_water(const Host& host, const ColumnSettings& settings)
{
    StillColumn column(host, settings);
    if (settings.solver != Solver::Wcsph) { // solved pressure has no sound
        return column.profile(10.0, 100, 25);
    }
    column.settle();
    column.run(2.5);
    column.settle();
    return column.profile(10.0, 100);
}

Outcome run_still_water(const Host& host)
{
    Outcome outcome;
    plot::LinePlot plot{.title = "Water at rest: how it moves",
                        .x_label = "time, s",
                        .y_label = "kinetic energy, of 1e-6 rho g h V",
                        .curves = {},
                        .scale = plot::Scale::Linear};
    struct Run {
        const char* name;
        ColumnSettings settings;
    };
    for (const auto& [name, settings] :
         {Run{"wcsph", {.layers = 20, .viscosity = 0.001f}}, Run{"wcsph, 0.5 Pa s", {.layers = 20}},
          Run{"dfsph, H = 2 d", {.layers = 20, .solver = Solver::Dfsph, .support_ratio = 2.0f, .viscosity = 0.001f}},
          Run{"dfsph, H = 3 d", {.layers = 20, .solver = Solver::Dfsph, .viscosity = 0.001f}}}) {
        const std::string what = fmt::format("{}: ", name);
        const ColumnProfile profile = measure_still_water(host, settings);
        outcome.measurements.push_back(
            at_most(what + "kinetic energy, most, of rho g h V", profile.largest_energy(), 1e-4));
        outcome.measurements.push_back(
            at_most(what + "energy of the last quarter, of the one before", profile.trend(), 1.1));
        outcome.measurements.push_back(within(what + "depth, of the exact one", profile.depth, 0.99, 1.01));
        // A ripple of a part of a layer's weight, whatever the depth: 40 layers are held to 3 %.
        outcome.measurements.push_back(at_most(what + "pressure, L2 of its error", profile.pressure_error, 0.06));
        plot::Curve curve{name, {}};
        for (std::size_t i = 0; i < profile.energy.size(); ++i) {
            curve.points.emplace_back(0.1 * static_cast<double>(i + 1), 1e6 * profile.energy[i]);
        }
        plot.curves.push_back(curve);
    }
    outcome.figures.push_back({"still_water.svg", plot});
    return outcome;
}

} // namespace meltpoint::validation
