#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/context.h"
#include "particles/particle_set.h"
#include "sim/simulation.h"

namespace meltpoint::conformance {

/// How far one pass on the device is from its twin in double precision.
struct PassError {
    std::string pass;
    double error = 0.0; ///< as the pass's measure below defines it; 0 or 1 for passes that are right or wrong
    double bound = 0.0; ///< the largest error that conforms
    std::uint64_t excluded =
        0; ///< cases left out because rounding alone decides them: pairs within 1e-6 H of the support
           ///< radius, cells whose border is nearer than that, pressures within 1e-6 rho0 of their clamp

    [[nodiscard]] bool conforms() const { return error <= bound; } // false for NaN
};

inline constexpr double pass_bound = 1e-5;
inline constexpr double run_bound = 1e-3;

/// Runs every pass of one time step on the device, each twin fed with the very input that the pass had there.
///
/// Measures. Kick, drift, density: L2(gpu - ref) / L2(ref). Pressure: the same over c0^2 rho0 of each particle. Forces:
/// over the sum of the absolute values of the terms, since at rest they cancel. Sort: 1 unless the order is exactly
/// that of (cell, id) and nothing is lost. Neighbors: the share of particles with a wrong set. The solves' passes: over
/// the sum of the absolute values of the terms; counts of iterations: how far they are apart, of which 1 conforms.
[[nodiscard]] std::vector<PassError> compare_passes(const gpu::Context& context, const ParticleSet& particles,
                                                    const sim::SimulationSettings& settings);

/// Runs `steps` whole steps on both sides from the same state. After one step position and velocity are compared,
/// velocity over |v| + dt (sum of the absolute values of the acceleration's terms + c0^2 / H) (bound pass_bound); after
/// more, since trajectories diverge, kinetic energy against all mechanical energy in play and the center of mass
/// against the domain's size (bound run_bound).
[[nodiscard]] std::vector<PassError> compare_steps(const gpu::Context& context, const ParticleSet& particles,
                                                   const sim::SimulationSettings& settings, std::uint32_t steps);

} // namespace meltpoint::conformance
