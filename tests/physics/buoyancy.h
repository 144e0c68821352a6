#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "run/collider_forces.h"
#include "run/fluid_settings.h"
#include "run/scene_particles.h"
#include "support/gpu_test.h"

namespace meltpoint {

/// A ball held under still water in a box, and what it weighs less than in the air.
struct Buoyancy {
    double measured = 0.0; ///< N, upward, mean over the last time
    double sideways = 0.0; ///< N, the largest of the other two components
    double torque = 0.0;   ///< N m
    double exact = 0.0;    ///< rho g V, N
};

/// radius: of the ball, in spacings. Blue noise, for a lattice at rest bears shear: it held up 10 % of a ball's lift.
///
/// First the water gets 0.3 s to close up around the ball. Then it is left swinging about its compressed state in a
/// standing wave of sound whose length is 4 h: after h/c0 it passes through rest position, and velocities taken away
/// there leave little. After some rounds of that, the mean over two periods counts.
inline Buoyancy measure_buoyancy(const gpu::Context& context, Solver solver, double support_ratio, float radius,
                                 double measured_periods = 2.0)
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
    scene.fluids.push_back({.shape = BlockShape{scene.domain.min, top}, .lattice = FluidLattice::BlueNoise});
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

} // namespace meltpoint
