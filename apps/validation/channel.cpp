#include "validation/channel.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "validation/scene_run.h"

namespace meltpoint::validation {

namespace {

constexpr double length = 1e-3;    // L, m
constexpr double nu = 1e-6;        // m^2/s
constexpr double speed = 1.25e-5;  // U, m/s
constexpr double seconds = 1.0;    // L^2/nu: the slowest part of the start dies as exp(-pi^2 nu t/L^2)
constexpr std::uint32_t along = 8; // particles
constexpr std::size_t samples = 5;

std::string channel_name(const Channel& channel)
{
    return channel.couette ? "couette" : "poiseuille";
}

Scene channel_scene(const Channel& channel)
{
    const double spacing = length / channel.across;
    Scene scene;
    scene.name = fmt::format("{} {}", channel_name(channel), channel.across);
    scene.domain.min = glm::vec3(0.0f);
    scene.domain.max = glm::vec3(glm::dvec3(along * spacing, length, length));
    scene.domain.dimensions = 2;
    scene.domain.periodic = glm::bvec3(true, false, false);
    scene.particles.spacing = static_cast<float>(spacing);
    scene.particles.support_ratio = 3.0f;
    FluidBody fluid{.shape = BlockShape{scene.domain.min, scene.domain.max}};
    const double viscosity = channel.viscosity_factor * nu * static_cast<double>(fluid.rest_density);
    fluid.viscosity = static_cast<float>(viscosity);
    scene.fluids.push_back(fluid);
    scene.domain.wall_viscosity = static_cast<float>(2.0 * viscosity); // holds it fast
    scene.physics.gravity = glm::vec3(0.0f);
    if (channel.couette) {
        scene.domain.lid_velocity.x = static_cast<float>(channel.drive_factor * speed);
    } else {
        scene.physics.gravity.x = static_cast<float>(channel.drive_factor * 8.0 * nu * speed / (length * length));
    }
    scene.physics.speed_of_sound = static_cast<float>(10.0 * speed);
    scene.physics.viscosity_model = channel.implicit ? ViscosityModel::Implicit : ViscosityModel::Explicit;
    scene.solve.viscosity_error = 1e-4f;
    scene.solve.viscosity_iterations = std::max(100u, 2u * channel.across);
    const double support_radius = 3.0 * spacing;
    scene.time.dt =
        static_cast<float>(channel.implicit ? 0.02 * seconds : 0.025 * support_radius * support_radius / nu);
    scene.time.frame_rate = static_cast<float>(samples / seconds);
    return scene;
}

/// velocity/U at y/L.
double exact_velocity(const Channel& channel, double y)
{
    return channel.couette ? y : 4.0 * y * (1.0 - y);
}

Outcome run_channel(const Host& host, bool couette, std::string title)
{
    Outcome outcome;
    plot::LinePlot plot{.title = std::move(title),
                        .x_label = "y / L",
                        .y_label = "velocity / U",
                        .curves = {{"exact", {}}},
                        .scale = plot::Scale::Linear};
    for (int i = 0; i <= 40; ++i) {
        const double y = i / 40.0;
        plot.curves[0].points.emplace_back(y, exact_velocity({.couette = couette}, y));
    }
    const auto add = [&](const Channel& channel, const std::string& name) {
        const ChannelFlow flow = measure_channel(host, channel);
        outcome.measurements.push_back(at_most(name + ": velocity, largest error anywhere, of U", flow.error, 0.02));
        if (channel.implicit) {
            outcome.measurements.push_back(
                at_most(name + ": solves for viscosity that ended before their error was met", flow.unconverged, 0.0));
        }
        plot.curves.push_back({name, flow.profile, false});
    };
    for (const std::uint32_t across : {50u, 100u, 200u}) {
        add({.across = across, .couette = couette}, fmt::format("L = {} d", across));
    }
    add({.across = 50, .couette = couette, .implicit = false}, "L = 50 d, explicit");
    outcome.figures.push_back({channel_name({.couette = couette}) + ".svg", plot});
    return outcome;
}

} // namespace

ChannelFlow measure_channel(const Host& host, const Channel& channel)
{
    const Scene scene = channel_scene(channel);
    SceneRun run(host, scene, samples);
    for (std::size_t i = 0; i < samples; ++i) {
        run.advance_by(seconds / samples);
    }
    ChannelFlow flow;
    if (const auto solves = run.simulation().take_viscosity_statistics()) {
        flow.unconverged = solves->unconverged;
    }
    constexpr std::size_t slices = 25;
    struct Slice {
        double y = 0.0;
        double velocity = 0.0;
        double count = 0.0;
    };
    std::vector<Slice> slice(slices);
    const ParticleSet& set = run.particles();
    for (std::size_t i = 0; i < set.size(); ++i) {
        const double y = static_cast<double>(set.position[i].y) / length;
        const double velocity = static_cast<double>(set.velocity[i].x) / speed;
        flow.error = std::max(flow.error, std::abs(velocity - exact_velocity(channel, y)));
        Slice& own = slice[std::min(slices - 1, static_cast<std::size_t>(y * slices))];
        own.y += y;
        own.velocity += velocity;
        own.count += 1.0;
    }
    for (const Slice& each : slice) {
        if (each.count > 0.0) {
            flow.profile.emplace_back(each.y / each.count, each.velocity / each.count);
        }
    }
    return flow;
}

Outcome run_poiseuille(const Host& host)
{
    return run_channel(host, false, "Between two plates, driven by a force");
}

Outcome run_couette(const Host& host)
{
    return run_channel(host, true, "Between two plates, one of which moves");
}

} // namespace meltpoint::validation
