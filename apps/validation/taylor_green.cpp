#include "validation/taylor_green.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "validation/scene_run.h"

namespace meltpoint::validation {

namespace {

constexpr double length = 1.0; // L, m
constexpr double speed = 1.0;  // U, m/s
constexpr double reynolds = 100.0;
constexpr double nu = speed * length / reynolds;
constexpr double wave_number = 2.0 * std::numbers::pi / length;
constexpr double exact_rate = 2.0 * wave_number * wave_number * nu; // 1/s, of the velocity

Scene taylor_green_scene(const TaylorGreen& flow)
{
    Scene scene;
    scene.name = fmt::format("taylor_green {}", flow.across);
    scene.domain.min = glm::vec3(0.0f);
    scene.domain.max = glm::vec3(length);
    scene.domain.dimensions = 2;
    scene.domain.periodic = glm::bvec3(true, true, false);
    scene.particles.spacing = static_cast<float>(length / flow.across);
    scene.particles.support_ratio = 3.0f;
    scene.physics.gravity = glm::vec3(0.0f);
    scene.physics.viscosity_model = ViscosityModel::Explicit;
    scene.physics.state_equation = StateEquation::Linear;
    scene.physics.clamp_pressure = false; // it is as often negative as positive
    scene.physics.speed_of_sound = static_cast<float>(10.0 * speed);
    scene.physics.shifting = flow.shifting;
    FluidBody fluid{.shape = BlockShape{scene.domain.min, scene.domain.max}};
    fluid.viscosity = static_cast<float>(flow.viscosity_factor * nu * static_cast<double>(fluid.rest_density));
    scene.fluids.push_back(fluid);
    return scene;
}

ParticleSet vortices(const Host& host, const Scene& scene)
{
    ParticleSet set = make_particles(scene, sim::Simulation::particle_limit(host.context));
    for (std::size_t i = 0; i < set.size(); ++i) {
        const glm::dvec2 x = wave_number * glm::dvec2(set.position[i]);
        set.velocity[i] = glm::dvec3(std::sin(x.x) * std::cos(x.y), -std::cos(x.x) * std::sin(x.y), 0.0) * speed;
    }
    return set;
}

} // namespace

Decay measure_decay(const Host& host, const TaylorGreen& flow, double first, double last)
{
    constexpr std::size_t samples = 18;
    const Scene scene = taylor_green_scene(flow);
    SceneRun run(host, scene, vortices(host, scene), samples + 1);
    const double start = run.statistics().kinetic_energy;
    Decay decay{.speed = {{0.0, 1.0}}};
    const auto look_after = [&](double seconds) {
        run.advance_by(seconds);
        const double energy = run.statistics().kinetic_energy;
        decay.speed.emplace_back(run.time() * speed / length, std::sqrt(energy / start));
        return energy;
    };
    const double before = look_after(first * length / speed);
    const double since = run.time();
    double after = before;
    for (std::size_t i = 0; i < samples; ++i) {
        after = look_after((last - first) * length / speed / samples);
    }
    decay.rate = 0.5 * std::log(before / after) / (run.time() - since) / exact_rate;
    return decay;
}

Outcome run_taylor_green(const Host& host)
{
    Outcome outcome;
    plot::LinePlot plot{.title = "Taylor-Green vortices: how they die",
                        .x_label = "t U / L",
                        .y_label = "velocity, of the first (root mean square)",
                        .curves = {{"exact", {}}},
                        .scale = plot::Scale::Linear};
    for (int i = 0; i <= 20; ++i) {
        const double time = 0.05 * i;
        plot.curves[0].points.emplace_back(time, std::exp(-exact_rate * time * length / speed));
    }
    for (const std::uint32_t across : {50u, 100u, 200u}) {
        const Decay decay = measure_decay(host, {.across = across});
        outcome.measurements.push_back(
            within(fmt::format("L = {} d: rate of decay, of the exact one", across), decay.rate, 0.95, 1.05));
        plot.curves.push_back({fmt::format("L = {} d", across), decay.speed, false});
    }
    // What shifting is for: the flow draws rows of particles apart, between which there are gaps.
    const Decay without = measure_decay(host, {.across = 100, .shifting = 0.0f});
    outcome.measurements.push_back(
        at_least("L = 100 d: rate of decay without shifting, of the exact one", without.rate, 1.05));
    plot.curves.push_back({"not shifted", without.speed, false});
    outcome.figures.push_back({"taylor_green.svg", plot});
    return outcome;
}

} // namespace meltpoint::validation
