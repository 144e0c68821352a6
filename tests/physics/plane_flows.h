#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/fluid_box.h"
#include "support/gpu_test.h"

namespace meltpoint {

/// The flows of a plane whose solutions are exact, at any resolution: the numbers of Reynolds decide, not the meters.
/// Wendland kernel at H = 3 d.

/// Taylor & Green 1937: in a square of side L, periodic, v = U (sin kx cos ky, -cos kx sin ky), k = 2 pi/L, dies as
/// exp(-2 k^2 nu t), that is, exp(-8 pi^2 nu t/L^2).
struct TaylorGreen {
    std::uint32_t across = 100;    ///< particles
    double reynolds = 100.0;       ///< U L/nu
    float shifting = 5.0f;         ///< diffusion coefficient in H/2 times U
    double viscosity_factor = 1.0; ///< for what shall go wrong

    /// What is measured.
    struct Decay {
        double rate = 0.0;          ///< of the velocity, over the exact one
        double density_error = 0.0; ///< at the end, of rho/rho0, root mean square
    };

    /// From `first` to `last` in times L/U.
    [[nodiscard]] Decay decay(const gpu::Context& context, double first, double last) const
    {
        const double length = across * static_cast<double>(test_spacing);
        const double speed = 1.0;
        const double nu = speed * length / reynolds;
        sim::SimulationSettings settings =
            plane_box_settings(shared::KERNEL_WENDLAND, 3.0, glm::uvec2(across), speed,
                               viscosity_factor * nu * static_cast<double>(test_rest_density));
        settings.params.wall_mask = 0;
        settings.params.periodic_mask = 0x0f;
        settings.params.gravity = glm::vec3(0.0f);
        settings.params.clamp_pressure = 0;
        settings.params.state_equation = shared::STATE_EQUATION_LINEAR;
        settings.options.shifting = shifting > 0.0f;
        const double support_radius = static_cast<double>(settings.params.support_radius);
        settings.params.shifting = static_cast<float>(static_cast<double>(shifting) * 0.5 * support_radius * speed);
        settings.params.dt = static_cast<float>(
            std::min(static_cast<double>(settings.params.dt), 0.06 * support_radius * support_radius / nu));

        ParticleSet set = square_state(glm::uvec2(across), glm::vec2(0.5f * test_spacing));
        const double k = 2.0 * std::numbers::pi / length;
        for (std::size_t i = 0; i < set.size(); ++i) {
            const glm::dvec2 x = k * glm::dvec2(set.position[i]);
            set.velocity[i] = glm::dvec3(std::sin(x.x) * std::cos(x.y), -std::cos(x.x) * std::sin(x.y), 0.0) * speed;
        }
        sim::Simulation simulation(context, set, settings);
        simulation.advance(steps_for(first * length / speed, settings));
        const double start = kinetic_energy(simulation.download());
        const double since = simulation.time();
        simulation.advance(steps_for((last - first) * length / speed, settings));
        const ParticleSet end = simulation.download();
        Decay result;
        result.rate = 0.5 * std::log(start / kinetic_energy(end)) / (simulation.time() - since) / (2.0 * k * k * nu);
        for (const float density : end.density) {
            result.density_error += std::pow(static_cast<double>(density / test_rest_density) - 1.0, 2);
        }
        result.density_error = std::sqrt(result.density_error / static_cast<double>(end.size()));
        return result;
    }
};

/// Fluid between two plates L apart, periodic along them, Re = U L/nu = 0.0125 (Morris, Fox & Zhu 1997): driven by a
/// body force that makes it U fast in the middle (Poiseuille), or by the upper plate that moves at U (Couette).
struct Channel {
    std::uint32_t across = 50; ///< particles
    bool couette = false;
    bool implicit = true;          ///< viscosity is solved for
    double viscosity_factor = 1.0; ///< for what shall go wrong
    double drive_factor = 1.0;

    static constexpr double reynolds = 0.0125;

    /// The largest difference to the exact profile once the flow is steady, over U.
    [[nodiscard]] double error(const gpu::Context& context) const
    {
        const std::uint32_t along = 8;
        const double length = across * static_cast<double>(test_spacing);
        const double speed = 1.0;
        const double nu = speed * length / reynolds;
        const double viscosity = viscosity_factor * nu * static_cast<double>(test_rest_density);
        sim::SimulationSettings settings =
            plane_box_settings(shared::KERNEL_WENDLAND, 3.0, {along, across}, speed, viscosity);
        settings.params.wall_mask = 0x0c;
        settings.params.periodic_mask = 0x03;
        settings.params.wall_viscosity = static_cast<float>(2.0 * viscosity); // holds it fast
        settings.params.gravity = glm::vec3(0.0f);
        if (couette) {
            settings.params.lid_velocity.x = static_cast<float>(drive_factor * speed);
        } else {
            settings.params.gravity.x = static_cast<float>(drive_factor * 8.0 * nu * speed / (length * length));
        }
        settings.options.implicit_viscosity = implicit;
        settings.params.viscosity_error = 1e-4f;
        settings.params.viscosity_iterations = 400;
        const double time = length * length / nu; // the slowest part of the start dies as exp(-pi^2 t/time)
        const double support_radius = static_cast<double>(settings.params.support_radius);
        settings.params.dt = static_cast<float>(implicit ? 0.02 * time : 0.025 * support_radius * support_radius / nu);
        const ParticleSet set = square_state({along, across}, glm::vec2(0.5f * test_spacing));
        sim::Simulation simulation(context, set, settings);
        simulation.advance(steps_for(time, settings));
        const ParticleSet later = simulation.download();
        double worst = 0.0;
        for (std::size_t i = 0; i < later.size(); ++i) {
            const double y = static_cast<double>(later.position[i].y) / length;
            const double exact = couette ? speed * y : 4.0 * speed * y * (1.0 - y);
            worst = std::max(worst, std::abs(static_cast<double>(later.velocity[i].x) - exact) / speed);
        }
        return worst;
    }
};

} // namespace meltpoint
