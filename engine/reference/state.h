#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "particles/particle_set.h"
#include "shared/particle_state.h"
#include "shared/sph_params.h"

namespace meltpoint::reference {

/// What the passes read besides the particles: the very structure that the GPU reads. The twins promote its floats to
/// double, so that a comparison shows the error of the arithmetic and not that of the input.
struct Settings {
    std::uint32_t kernel = shared::KERNEL_PAPER;
    shared::SphParams params{};
    std::uint32_t solver = shared::SOLVER_WCSPH;
    bool implicit_viscosity = false; ///< solved for (reference/viscosity)
    std::uint32_t dimensions = 3;    ///< or 2
};

/// What a run has noticed: its first fault, and the pairs without direction of the last force evaluation.
struct RunStatus {
    std::uint32_t fault = shared::FAULT_NONE; ///< one of shared::FAULT_*
    std::uint32_t step = 0;                   ///< in which it happened
    std::uint32_t particle = 0;               ///< the faulty particle of smallest id in that step
    std::uint32_t coincident = 0;             ///< ordered pairs nearer than COINCIDENT_RATIO support radii
};

/// The particles in double precision, one array an attribute, all of the same length, in id order. SI units.
struct State {
    std::vector<std::uint32_t> id;
    std::vector<std::uint32_t> attributes; ///< shared::pack_attributes(state, material) and flags
    std::vector<glm::dvec3> position;      ///< m
    std::vector<glm::dvec3> velocity;      ///< m/s
    std::vector<glm::dvec3> acceleration;  ///< m/s^2
    std::vector<double> mass;              ///< kg; 0 for colliders
    std::vector<double> weight;            ///< in its neighbors' number density
    std::vector<double> density;           ///< kg/m^3
    std::vector<double> pressure;          ///< Pa

    /// m/s^2, what the last viscosity solve did; empty before the first one.
    std::vector<glm::dvec3> viscous_acceleration;

    RunStatus status;
    std::uint32_t step = 0; ///< index of the step to come

    [[nodiscard]] std::size_t size() const { return position.size(); }
};

/// Every attribute promoted to double.
[[nodiscard]] State from_particle_set(const ParticleSet& particles);

/// Every attribute rounded to float.
[[nodiscard]] ParticleSet to_particle_set(const State& state);

[[nodiscard]] inline bool is_boundary(const State& state, std::size_t i)
{
    return shared::is_boundary(state.attributes[i]);
}

/// Rest density of particle i's material, kg/m^3.
[[nodiscard]] inline double rest_density(const Settings& settings, const State& state, std::size_t i)
{
    return static_cast<double>(settings.params.rest_density[shared::particle_material(state.attributes[i])]);
}

} // namespace meltpoint::reference
