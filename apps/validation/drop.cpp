#include "validation/drop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "core/random.h"
#include "scene/liquids.h"
#include "validation/scene_run.h"

namespace meltpoint::validation {

namespace {

constexpr double radius = 1e-3; // m
constexpr double pi = std::numbers::pi;
constexpr float widest_in_the_plane = 2.5f; // support ratio: wider, and the outermost layers bear no pressure

const Liquid& water()
{
    return *find_liquid("water");
}

double tension()
{
    return static_cast<double>(water().surface_tension);
}

double rest_density()
{
    return static_cast<double>(water().rest_density);
}

/// s, in which tension moves a drop.
double capillary_time()
{
    return std::sqrt(rest_density() * std::pow(radius, 3.0) / tension());
}

/// Viscosity that is one in the units of tension, density and length, Pa s.
double viscosity_unit(double length)
{
    return std::sqrt(tension() * rest_density() * length);
}

/// Gravity is none, and sound so fast that the drop's pressure compresses it by half a percent.
Scene tension_scene(std::string name, double spacing, double tension_factor)
{
    Scene scene;
    scene.name = std::move(name);
    scene.particles.spacing = static_cast<float>(spacing);
    scene.physics.gravity = glm::vec3(0.0f);
    scene.physics.speed_of_sound = static_cast<float>(std::sqrt(2.0 * tension() / (rest_density() * radius) / 0.005));
    FluidBody body{.lattice = BodyLattice::BlueNoise};
    set_liquid(body, water());
    body.surface_tension = static_cast<float>(tension_factor * tension());
    scene.fluids.push_back(body);
    return scene;
}

Scene drop_scene(const DropSettings& settings)
{
    Scene scene =
        tension_scene(fmt::format("drop {:g}", settings.radius), radius / settings.radius, settings.tension_factor);
    scene.solver = settings.solver;
    scene.domain.dimensions = settings.dimensions;
    scene.domain.min = glm::vec3(static_cast<float>(-2.0 * radius));
    scene.domain.max = -scene.domain.min;
    scene.domain.walls = false;
    scene.particles.support_ratio = settings.support_ratio;
    scene.fluids[0].shape = SphereShape{glm::vec3(0.0f), static_cast<float>(radius)};
    if (settings.dimensions == 2) { // where there is no blue noise
        scene.fluids[0].lattice = BodyLattice::Cubic;
    }
    return scene;
}

/// In the plane there is no blue noise, and the rows of a lattice end in steps: jitter makes the rim as rough
/// everywhere.
ParticleSet drop_particles(const Scene& scene)
{
    ParticleSet set = make_particles(scene, 1'000'000);
    if (scene.domain.dimensions == 2) {
        Random random(scene.seed);
        for (glm::vec3& x : set.position) {
            const glm::dvec3 shift(random.uniform() - 0.5, random.uniform() - 0.5, 0.0);
            x += 0.3f * scene.particles.spacing * glm::vec3(shift);
        }
    }
    return set;
}

/// Of the volume that so many particles have, m.
double radius_of(const ParticleSet& set, const DropSettings& settings)
{
    const double spacing = radius / settings.radius;
    const double volume = static_cast<double>(set.size()) * std::pow(spacing, settings.dimensions);
    return settings.dimensions == 3 ? std::cbrt(3.0 * volume / (4.0 * pi)) : std::sqrt(volume / pi);
}

glm::dvec3 center_of(const ParticleSet& set)
{
    glm::dvec3 sum(0.0);
    for (const glm::vec3& x : set.position) {
        sum += glm::dvec3(x);
    }
    return sum / static_cast<double>(set.size());
}

double inner_pressure(const ParticleSet& set, double inner_radius)
{
    const glm::dvec3 center = center_of(set);
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < set.size(); ++i) {
        if (glm::length(glm::dvec3(set.position[i]) - center) < inner_radius) {
            sum += static_cast<double>(set.pressure[i]);
            count += 1.0;
        }
    }
    return sum / count;
}

/// Length along y over width across, less 1: of second moments.
double stretch_of(const ParticleSet& set, std::uint32_t dimensions)
{
    const glm::dvec3 center = center_of(set);
    glm::dvec3 moment(0.0);
    for (const glm::vec3& x : set.position) {
        const glm::dvec3 offset = glm::dvec3(x) - center;
        moment += offset * offset;
    }
    const double across = (moment.x + moment.z) / (dimensions - 1.0);
    return std::sqrt(moment.y / across) - 1.0;
}

} // namespace

double measure_laplace(const Host& host, const DropSettings& settings)
{
    constexpr std::size_t samples = 60;
    Scene scene = drop_scene(settings);
    scene.fluids[0].viscosity = static_cast<float>(0.1 * viscosity_unit(radius / settings.radius));
    scene.solve.density_error = 2e-5f; // a solve that ends at 5e-4 leaves a tenth of the pressure open
    SceneRun run(host, scene, drop_particles(scene), samples);
    const double drop_radius = radius_of(run.particles(), settings);
    const double inner_radius =
        drop_radius - (static_cast<double>(settings.support_ratio) + 0.5) * radius / settings.radius;
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t sample = 1; sample <= samples; ++sample) {
        run.advance_by(3.0 * capillary_time() / samples);
        if (3 * sample > 2 * samples) {
            sum += inner_pressure(run.particles(), inner_radius);
            count += 1.0;
        }
    }
    return sum / count * drop_radius / (tension() * (settings.dimensions - 1.0));
}

DropSwing measure_swing(const Host& host, const DropSettings& settings)
{
    constexpr std::size_t samples_a_period = 60;
    constexpr std::size_t samples = samples_a_period * 3 / 2;
    constexpr double drawn_out = 1.1;
    const Scene scene = drop_scene(settings);
    ParticleSet set = drop_particles(scene);
    const double narrowed = std::pow(drawn_out, -1.0 / (settings.dimensions - 1.0));
    for (glm::vec3& x : set.position) {
        x = glm::vec3(glm::dvec3(x) * glm::dvec3(narrowed, drawn_out, narrowed));
    }
    const double stiffness = settings.dimensions == 3 ? 8.0 : 6.0;
    const double exact =
        2.0 * pi * std::sqrt(rest_density() * std::pow(radius_of(set, settings), 3.0) / (stiffness * tension()));
    SceneRun run(host, scene, set, samples);
    DropSwing swing{.stretch = {{0.0, stretch_of(set, settings.dimensions)}}};
    std::vector<double> crossings; // of the round drop: a quarter of a period, three and five
    for (std::size_t sample = 1; sample <= samples; ++sample) {
        run.advance_by(exact / samples_a_period);
        const auto [time, before] = swing.stretch.back();
        const double now = run.time() / exact;
        const double stretch = stretch_of(run.particles(), settings.dimensions);
        if ((before > 0.0) != (stretch > 0.0)) {
            crossings.push_back(time + (now - time) * before / (before - stretch));
        }
        swing.stretch.emplace_back(now, stretch);
    }
    swing.period = crossings.size() >= 3 ? crossings[2] - crossings[0] : std::numeric_limits<double>::quiet_NaN();
    return swing;
}

double measure_contact_angle(const Host& host, const ContactSettings& settings)
{
    constexpr std::size_t samples = 50;
    constexpr std::size_t averaged = 10;
    const double width = 1.6 * radius;
    const double spacing = width / settings.across;
    const auto m = [](double x) {
        return static_cast<float>(x);
    };
    Scene scene = tension_scene(fmt::format("contact angle {:g}", settings.angle), spacing, 1.0);
    scene.domain.min = glm::vec3(m(-2.5 * radius), 0.0f, m(-2.5 * radius));
    scene.domain.max = glm::vec3(m(2.5 * radius), m(2.5 * radius), m(2.5 * radius));
    const glm::vec3 low(m(-0.5 * width), 0.0f, m(-0.5 * width));
    const glm::vec3 high(m(0.5 * width), m(radius), m(0.5 * width));
    scene.fluids[0].shape = BlockShape{low, high};
    scene.fluids[0].viscosity = m(0.25 * viscosity_unit(spacing));
    scene.domain.contact_angle = settings.angle;
    SceneRun run(host, scene, samples);
    double height = 0.0;
    for (std::size_t sample = 1; sample <= samples; ++sample) {
        run.advance_by(6.0 * capillary_time() / samples);
        const ParticleSet& set = run.particles();
        double highest = 0.0;
        for (std::size_t i = 0; i < set.size(); ++i) {
            const bool splash =
                static_cast<double>(set.density[i]) < 0.6 * rest_density(); // that the block's corners made
            if (!splash) {
                highest = std::max(highest, static_cast<double>(set.position[i].y) + 0.5 * spacing);
            }
        }
        height += sample > samples - averaged ? highest / averaged : 0.0;
    }
    const double volume = static_cast<double>(run.particles().size()) * std::pow(spacing, 3.0);
    const double sphere = (3.0 * volume / (pi * height * height) + height) / 3.0; // V = pi h^2 (3 R - h) / 3
    return std::acos(std::clamp(1.0 - height / sphere, -1.0, 1.0)) * 180.0 / pi;
}

Outcome run_laplace(const Host& host)
{
    Outcome outcome;
    plot::LinePlot plot{.title = "Pressure in a drop at rest, in parts of Laplace's",
                        .x_label = "radius / spacing",
                        .y_label = "measured / exact",
                        .curves = {},
                        .scale = plot::Scale::Linear};
    const auto measure = [&](std::string_view name, const std::vector<double>& sizes, DropSettings settings) {
        plot::Curve curve{std::string(name), {}};
        for (const double size : sizes) {
            settings.radius = size;
            const double pressure = measure_laplace(host, settings);
            outcome.measurements.push_back(
                within(fmt::format("{}, radius {:g} d: pressure, in parts of sigma kappa", name, size), pressure, 0.9,
                       1.1)); // tension a fifth off is out of it
            curve.points.emplace_back(size, pressure);
        }
        plot.curves.push_back(curve);
    };
    measure("wcsph", {8.0, 12.0, 16.0}, {});
    measure("dfsph", {8.0, 12.0, 16.0}, {.solver = Solver::Dfsph});
    measure("plane", {10.0, 20.0, 40.0}, {.dimensions = 2, .support_ratio = widest_in_the_plane});
    outcome.figures.push_back({"laplace.svg", plot});
    return outcome;
}

Outcome run_drop(const Host& host)
{
    Outcome outcome;
    plot::LinePlot plot{.title = "A drop drawn out by a tenth and let go",
                        .x_label = "time / Rayleigh's period",
                        .y_label = "length / width - 1",
                        .curves = {},
                        .scale = plot::Scale::Linear};
    const auto measure = [&](std::string_view name, const DropSettings& settings) {
        const DropSwing swing = measure_swing(host, settings);
        outcome.measurements.push_back(
            within(fmt::format("{}, radius {:g} d: period, in parts of the exact one", name, settings.radius),
                   swing.period, 0.93, 1.07)); // tension a fifth off is out of it
        plot.curves.push_back({fmt::format("{}, radius {:g} d", name, settings.radius), swing.stretch});
    };
    measure("wcsph", {.radius = 8.0});
    measure("wcsph", {.radius = 12.0});
    measure("dfsph", {.radius = 12.0, .solver = Solver::Dfsph});
    measure("plane", {.radius = 20.0, .dimensions = 2, .support_ratio = widest_in_the_plane});
    outcome.figures.push_back({"drop.svg", plot});
    return outcome;
}

Outcome run_contact_angle(const Host& host)
{
    Outcome outcome;
    plot::LinePlot plot{.title = "A block of water becomes a cap",
                        .x_label = "contact angle asked for, degrees",
                        .y_label = "of the cap",
                        .curves = {},
                        .scale = plot::Scale::Linear};
    plot::Curve curve{"measured", {}};
    for (const float angle : {60.0f, 90.0f, 120.0f}) {
        const double measured = measure_contact_angle(host, {.angle = angle});
        const double wanted = static_cast<double>(angle);
        outcome.measurements.push_back(
            within(fmt::format("angle of {:g} degrees: degrees", angle), measured, wanted - 10.0, wanted + 10.0));
        curve.points.emplace_back(wanted, measured);
    }
    plot.curves.push_back(curve);
    outcome.figures.push_back({"contact_angle.svg", plot});
    return outcome;
}

} // namespace meltpoint::validation
