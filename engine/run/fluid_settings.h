#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "particles/particle_set.h"
#include "scene/scene.h"
#include "sim/simulation.h"

namespace meltpoint {

/// The speed that the fluid of a scene may reach, m/s: its fastest particle, plus free fall from the highest to the
/// lowest place of the domain that lies below it. At least 1 m/s where neither gravity nor velocities say anything.
[[nodiscard]] double expected_speed(const Scene& scene, const ParticleSet& particles);

/// The largest stable time steps (s) at support radius S, each the bound of one thing.
struct TimeStepBounds {
    double cfl = 0.0; ///< 0.4 (S/2) / (c0 + v)
    double viscosity =
        0.0; ///< 0.06 rho S^2 / mu, infinite without viscosity; does not hold where viscosity is solved for

    double tension = 0.0; ///< 0.2 sqrt(rho d^3 / sigma), of the fastest ripples; infinite without tension

    [[nodiscard]] double smallest() const { return std::min({cfl, viscosity, tension}); }
};
/// speed_of_sound: c0, m/s. speed: v, the fastest that the fluid is expected to move, m/s.
[[nodiscard]] TimeStepBounds time_step_bounds(const Scene& scene, double speed_of_sound, double speed);

struct FluidSettings {
    sim::SimulationSettings simulation;
    std::vector<std::string>
        warnings; ///< sentences: a dt above its bounds, a viscosity too low for the paper's kernels
};

/// The same with every step params.dt long: for those who compare, or time, step by step.
[[nodiscard]] sim::SimulationSettings with_fixed_steps(sim::SimulationSettings settings);

/// Whether viscosity is solved for: as the scene says, or, automatically, where its bound would be the shortest of
/// `bounds`, a frame and time.dt.
[[nodiscard]] bool solves_viscosity(const Scene& scene, const TimeStepBounds& bounds);

/// What the passes need of a scene: automatic speed of sound and dt resolved, kernel scales computed. An automatic dt
/// is left to the device, with its bounds; params.dt is then what the bounds allow at the expected speed. Throws Input
/// when dt is longer than a frame or so short that the run's steps cannot be counted, and when walls stand closer than
/// two support radii.
[[nodiscard]] FluidSettings fluid_settings(const Scene& any_scene, const ParticleSet& particles);

} // namespace meltpoint
