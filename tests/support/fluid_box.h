#pragma once

#include <algorithm>
#include <cmath>

#include "reference/measure.h"
#include "support/fluid_states.h"

namespace meltpoint {

/// As the device has it: a float, so that an exact solution does not differ by its rounding.
inline constexpr double test_gravity = static_cast<double>(9.81f);

/// A box with walls, `box` test spacings along each axis from the origin: speed of sound ten times the expected speed,
/// time step at the CFL bound (Monaghan 1994). viscosity in Pa s.
inline sim::SimulationSettings box_settings(std::uint32_t kernel, double support_ratio, const glm::uvec3& box,
                                            double expected_speed, double viscosity)
{
    sim::SimulationSettings settings = test_settings(kernel);
    shared::SphParams& params = settings.params;
    params.domain_max = test_spacing * glm::vec3(box);
    params.support_radius = static_cast<float>(support_ratio) * test_spacing;
    params.speed_of_sound = static_cast<float>(10.0 * expected_speed);
    set_viscosity(params, static_cast<float>(viscosity));
    params.dt = 0.4f * 0.5f * params.support_radius / (1.1f * params.speed_of_sound);
    params.speed_limit = params.speed_of_sound;
    set_kernel_scales(params, kernel, static_cast<double>(test_spacing));
    return settings;
}

/// The same in the plane.
inline sim::SimulationSettings plane_box_settings(std::uint32_t kernel, double support_ratio, const glm::uvec2& box,
                                                  double expected_speed, double viscosity)
{
    sim::SimulationSettings settings =
        box_settings(kernel, support_ratio, glm::uvec3(box, 1u), expected_speed, viscosity);
    lay_flat(settings);
    return settings;
}

/// The same in space for solved pressure, in steps that the device chooses: errors and bounds are the defaults of a
/// scene.
inline sim::SimulationSettings solved_box_settings(double support_ratio, const glm::uvec3& box, double expected_speed,
                                                   double viscosity)
{
    sim::SimulationSettings settings =
        box_settings(shared::KERNEL_WENDLAND, support_ratio, box, expected_speed, viscosity);
    settings.options.solver = shared::SOLVER_DFSPH;
    shared::SphParams& params = settings.params;
    params.adaptive_dt = 1;
    params.cfl_length = 0.4f * test_spacing;
    params.cfl_speed = 0.0f;
    params.longest_dt = 5e-3f;
    params.longest_move = 0.5f * params.support_radius;
    params.density_error = 5e-4f;
    params.divergence_error = 1e-3f;
    params.max_iterations = 60;
    return settings;
}

/// Fluid in the corner of the box, a lattice that lies half a spacing off the walls: at rest density everywhere.
inline ParticleSet fluid_in_corner(const glm::uvec3& size)
{
    return lattice_state(size, glm::vec3(0.5f * test_spacing));
}

inline std::uint32_t steps_for(double seconds, const sim::SimulationSettings& settings)
{
    return static_cast<std::uint32_t>(std::lround(seconds / static_cast<double>(settings.params.dt)));
}

inline double kinetic_energy(const ParticleSet& set)
{
    return reference::kinetic_energy(reference::from_particle_set(set));
}

/// Kinetic and potential energy, J. That of compression is left out: about 1 % of the kinetic one at Mach 0.1.
inline double mechanical_energy(const ParticleSet& set, const sim::SimulationSettings& settings)
{
    const reference::State state = reference::from_particle_set(set);
    return reference::kinetic_energy(state) +
           reference::potential_energy({settings.options.kernel, settings.params}, state);
}

/// max(0, rho/rho0 - 1) of one particle.
inline double density_error(float density)
{
    return std::max(0.0, static_cast<double>(density / test_rest_density) - 1.0);
}

inline double max_density_error(const ParticleSet& set)
{
    return density_error(*std::max_element(set.density.begin(), set.density.end()));
}

inline double mean_density_error(const ParticleSet& set)
{
    double sum = 0.0;
    for (const float density : set.density) {
        sum += density_error(density);
    }
    return sum / static_cast<double>(set.size());
}

inline std::size_t count_outside(const ParticleSet& set, const sim::SimulationSettings& settings)
{
    std::size_t outside = 0;
    for (std::size_t i = 0; i < set.size(); ++i) {
        const bool is_inside = glm::all(glm::greaterThanEqual(set.position[i], settings.params.domain_min)) &&
                               glm::all(glm::lessThanEqual(set.position[i], settings.params.domain_max));
        outside += !is_inside || (set.attributes[i] & shared::FLAG_LEFT_DOMAIN) != 0u ? 1 : 0;
    }
    return outside;
}

} // namespace meltpoint
