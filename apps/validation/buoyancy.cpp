#include "validation/buoyancy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "run/collider_forces.h"
#include "validation/scene_run.h"

namespace meltpoint::validation {

Buoyancy measure_buoyancy(const gpu::Context& context, Solver solver, double support_ratio, float radius,
                          double measured_periods)
{
    constexpr int rounds = 6;
    constexpr float d = 0.05f;
    const float half = std::ceil(radius + 3.0f); // walls three spacings off the ball
    Scene scene;
    scene.name = "buoyancy";
    scene.solver = solver;
    scene.domain.min = d * glm::vec3(-half, 0.0f, -half);
    scene.domain.max = d * glm::vec3(half, 2.0f * half + 4.0f, half);
    scene.particles.spacing = d;
    scene.particles.support_ratio = static_cast<float>(support_ratio);
    scene.physics.viscosity = 5.0f; // Pa s
    const float depth = 2.0f * half * d;
    const glm::vec3 top(scene.domain.max.x, depth, scene.domain.max.z);
    scene.fluids.push_back({.shape = BlockShape{scene.domain.min, top}, .lattice = BodyLattice::BlueNoise});
    const glm::vec3 center(0.0f, half * d, 0.0f);
    scene.colliders.push_back({.shape = SphereShape{center, radius * d}});
    const float speed_of_sound = 10.0f * std::sqrt(9.81f * depth);
    scene.physics.speed_of_sound = speed_of_sound;

    const SceneParticles start = make_scene_particles(scene, 1'000'000);
    const FluidSettings settings = fluid_settings(scene, start.particles);
    const auto quarter_period = static_cast<double>(depth / speed_of_sound);
    ParticleSet set = start.particles;
    for (int round = 0; round < rounds; ++round) {
        sim::Simulation simulation(context, set, settings.simulation);
        simulation.advance_by(round == 0 ? 0.3 : quarter_period);
        set = simulation.download();
        std::ranges::fill(set.velocity, glm::vec3(0.0f));
    }
    sim::Simulation simulation(context, set, settings.simulation);
    simulation.measure_boundary_forces();
    simulation.advance_by(measured_periods * 4.0 * quarter_period);
    const ColliderForce force = collider_forces(simulation.take_boundary_forces(), start.colliders).at(0);
    const glm::dvec3 total = force.total();
    return {.measured = total.y,
            .sideways = std::max(std::abs(total.x), std::abs(total.z)),
            .torque = glm::length(force.torque),
            .exact = 1000.0 * 9.81 * 4.0 / 3.0 * std::numbers::pi * std::pow(static_cast<double>(radius * d), 3)};
}

Outcome run_buoyancy(const Host& host)
{
    Outcome outcome;
    plot::LinePlot plot{.title = "Lift of a ball under water, in parts of Archimedes'",
                        .x_label = "radius / spacing",
                        .y_label = "measured / exact",
                        .curves = {},
                        .scale = plot::Scale::Linear};
    for (const Solver solver : {Solver::Wcsph, Solver::Dfsph}) {
        for (const double support_ratio : {2.0, 3.0}) {
            const std::string name = fmt::format("{}, H = {:g} d", solver_name(solver), support_ratio);
            plot::Curve curve{name, {}};
            for (const float radius : {4.0f, 8.0f}) {
                check_stop(host);
                const Buoyancy ball = measure_buoyancy(host.context, solver, support_ratio, radius);
                const double lift = ball.measured / ball.exact;
                const double error = radius < 5.0f ? 0.05 : 0.03;
                const std::string what = fmt::format("{}, radius {:g} d: ", name, radius);
                outcome.measurements.push_back(
                    within(what + "lift, in parts of rho g V", lift, 1.0 - error, 1.0 + error));
                outcome.measurements.push_back(
                    at_most(what + "force sideways, in the same parts", ball.sideways / ball.exact, 0.03));
                curve.points.emplace_back(radius, lift);
            }
            plot.curves.push_back(curve);
        }
    }
    outcome.figures.push_back({"buoyancy.svg", plot});
    return outcome;
}

} // namespace meltpoint::validation
