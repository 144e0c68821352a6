#include "validation/free_motion.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "validation/scene_run.h"

namespace meltpoint::validation {

namespace {

constexpr double gravity = static_cast<double>(9.81f); // as the device has it
constexpr double fall_seconds = 0.3;
constexpr std::size_t fall_samples = 10;
constexpr double rounding = 0x1p-24; // of a sum of floats, relative
constexpr Solver all_solvers[] = {Solver::Wcsph, Solver::Dfsph, Solver::Pbf};

/// A domain of 1 m without walls.
Scene free_scene(const FreeMotion& motion, const char* name, float size)
{
    Scene scene;
    scene.name = fmt::format("{} {}", name, motion.across);
    scene.solver = motion.solver;
    scene.domain.min = glm::vec3(-0.5f);
    scene.domain.max = glm::vec3(0.5f);
    scene.domain.walls = false;
    scene.particles.spacing = size / static_cast<float>(motion.across);
    scene.particles.support_ratio = 3.0f;
    scene.physics.viscosity = 0.0f;
    scene.pbf.speed_cap = 1.0f; // who is slowed down loses momentum, so none are
    scene.pbf.substeps = 10;
    return scene;
}

Scene drops_scene(const FreeMotion& motion)
{
    constexpr float radius = 0.1f;
    Scene scene = free_scene(motion, "two drops", 2.0f * radius);
    scene.physics.gravity = glm::vec3(0.0f);
    scene.physics.xsph = 0.0f; // viscosity of a kind
    const glm::vec3 place(0.11f, 0.05f, -0.02f);
    const glm::vec3 velocity(-1.0f, 0.0f, 0.3f);
    for (const float sign : {1.0f, -1.0f}) {
        scene.fluids.push_back({.shape = SphereShape{sign * place, radius},
                                .lattice = BodyLattice::BlueNoise,
                                .velocity = sign * velocity + glm::vec3(0.0f, 0.2f, 0.0f)});
    }
    return scene;
}

glm::dvec3 center_of_mass(const ParticleSet& set)
{
    glm::dvec3 sum(0.0);
    double mass = 0.0;
    for (std::size_t i = 0; i < set.size(); ++i) {
        sum += static_cast<double>(set.mass[i]) * glm::dvec3(set.position[i]);
        mass += static_cast<double>(set.mass[i]);
    }
    return sum / mass;
}

struct Momenta {
    glm::dvec3 linear{0.0};  ///< kg m/s
    glm::dvec3 angular{0.0}; ///< kg m^2/s, about the origin
    double linear_size = 0.0;
    double angular_size = 0.0;
};

Momenta momenta_of(const ParticleSet& set)
{
    Momenta sum;
    for (std::size_t i = 0; i < set.size(); ++i) {
        const glm::dvec3 arm(set.position[i]);
        const glm::dvec3 momentum = static_cast<double>(set.mass[i]) * glm::dvec3(set.velocity[i]);
        sum.linear += momentum;
        sum.angular += glm::cross(arm, momentum);
        sum.linear_size += glm::length(momentum);
        sum.angular_size += glm::length(arm) * glm::length(momentum);
    }
    return sum;
}

} // namespace

Fall measure_fall(const Host& host, const FreeMotion& motion)
{
    constexpr float size = 0.2f;
    Scene scene = free_scene(motion, "free fall", size);
    scene.physics.gravity.y = static_cast<float>(-motion.gravity_factor * gravity);
    if (motion.solver != Solver::Wcsph) {
        scene.time.dt = 2.5e-3f;         // all of one length, which the place shows
        scene.solve.max_iterations = 10; // there is nothing to solve for
    }
    scene.fluids.push_back({.shape = BlockShape{glm::vec3(-0.1f, 0.25f, -0.1f), glm::vec3(0.1f, 0.45f, 0.1f)}});
    SceneRun run(host, scene, fall_samples);
    const ParticleSet start = run.particles();
    Fall fall{.height = {{0.0, 0.0}}};
    for (std::size_t i = 0; i < fall_samples; ++i) {
        run.advance_by(fall_seconds / fall_samples);
        fall.height.emplace_back(run.time(), (center_of_mass(start) - center_of_mass(run.particles())).y);
    }
    const double time = run.time();
    const glm::dvec3 fallen = center_of_mass(run.particles()) - center_of_mass(start);
    const glm::dvec3 exact(0.0, -0.5 * gravity * time * time, 0.0);
    fall.place = glm::length(fallen - exact) / glm::length(exact);
    fall.ahead = (exact.y - fallen.y) / (gravity * time * run.mean_dt());
    const FrameStatistics& statistics = run.statistics();
    const glm::dvec3 velocity = statistics.momentum / statistics.mass;
    fall.speed = glm::length(velocity + glm::dvec3(0.0, gravity * time, 0.0)) / (gravity * time);
    fall.steps = time / run.mean_dt();
    return fall;
}

Encounter measure_encounter(const Host& host, const FreeMotion& motion)
{
    SceneRun run(host, drops_scene(motion), 1);
    const ParticleSet start = run.particles();
    run.advance_by(0.1);
    const Momenta before = momenta_of(start);
    const Momenta after = momenta_of(run.particles());
    double exchanged = 0.0;
    for (std::size_t i = 0; i < start.size(); ++i) {
        exchanged += static_cast<double>(start.mass[i]) *
                     static_cast<double>(glm::distance(start.velocity[i], run.particles().velocity[i]));
    }
    return {.momentum = glm::length(after.linear - before.linear) / before.linear_size,
            .angular_momentum = glm::length(after.angular - before.angular) / before.angular_size,
            .exchanged = exchanged / before.linear_size};
}

Outcome run_free_fall(const Host& host)
{
    Outcome outcome;
    plot::LinePlot plot{.title = "Free fall",
                        .x_label = "time, s",
                        .y_label = "fallen, m",
                        .curves = {{"g t^2/2", {}}},
                        .scale = plot::Scale::Linear};
    for (int i = 0; i <= 30; ++i) {
        const double time = fall_seconds * i / 30.0;
        plot.curves[0].points.emplace_back(time, 0.5 * gravity * time * time);
    }
    for (const Solver solver : all_solvers) {
        for (const std::uint32_t across : {4u, 8u, 16u}) {
            const Fall fall = measure_fall(host, {.solver = solver, .across = across});
            const std::string what = fmt::format("{}, {} across: ", solver_name(solver), across);
            // Steps are even, so all of them round alike; those of wcsph add to the velocity twice.
            const double sums = (solver == Solver::Wcsph ? 2.0 : 1.0) * fall.steps;
            outcome.measurements.push_back(
                at_most(what + "velocity, largest error, of g t", fall.speed, std::max(1e-5, sums * rounding)));
            if (solver == Solver::Wcsph) {
                outcome.measurements.push_back(at_most(what + "height, largest error, of g t^2/2", fall.place, 1e-5));
            } else { // steps of the first order: half a step ahead, whatever their length
                outcome.measurements.push_back(within(what + "ahead of g t^2/2, in steps", fall.ahead, 0.45, 0.55));
            }
            if (across == 16) {
                plot.curves.push_back({std::string(solver_name(solver)), fall.height, false});
            }
        }
    }
    outcome.figures.push_back({"free_fall.svg", plot});
    return outcome;
}

Outcome run_momentum(const Host& host)
{
    Outcome outcome;
    plot::LinePlot plot{.title = "Two drops meet: what their momentum changes by",
                        .x_label = "particles across a drop",
                        .y_label = "change, of the sum of magnitudes",
                        .curves = {},
                        .scale = plot::Scale::Logarithmic};
    for (const Solver solver : all_solvers) {
        plot::Curve curve{std::string(solver_name(solver)), {}};
        for (const std::uint32_t across : {6u, 12u, 24u}) {
            const Encounter encounter = measure_encounter(host, {.solver = solver, .across = across});
            const std::string what = fmt::format("{}, {} across: ", solver_name(solver), across);
            outcome.measurements.push_back(
                at_most(what + "momentum: its change, of the sum of magnitudes", encounter.momentum, 1e-6));
            // pbf moves particles along lines between places whose arms its velocities do not have yet: of first order.
            outcome.measurements.push_back(at_most(what + "angular momentum: its change, likewise",
                                                   encounter.angular_momentum, solver == Solver::Pbf ? 0.01 : 2e-6));
            outcome.measurements.push_back(
                at_least(what + "momentum exchanged meanwhile, likewise", encounter.exchanged, 0.2));
            curve.points.emplace_back(across, std::max(encounter.momentum, 1e-12)); // zero has no logarithm
        }
        plot.curves.push_back(curve);
    }
    outcome.figures.push_back({"momentum.svg", plot});
    return outcome;
}

} // namespace meltpoint::validation
