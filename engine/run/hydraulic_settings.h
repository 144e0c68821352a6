#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "particles/particle_set.h"
#include "scene/scene.h"
#include "sim/hydraulic.h"

namespace meltpoint {

/// Loose grains in a fluid.
struct Grains {
    double size = 0.0;          ///< m
    double density = 0.0;       ///< kg/m^3
    double fluid_density = 0.0; ///< kg/m^3
    double viscosity = 0.0;     ///< Pa s, dynamic, of the fluid
    double gravity = 0.0;       ///< m/s^2
};

/// D* = d (g (s - 1) / nu^2)^(1/3), s the grains' density over the fluid's; infinite in a fluid without viscosity
/// (Soulsby, Dynamics of Marine Sands, 1997, equation 75).
[[nodiscard]] double dimensionless_grain_size(const Grains& grains);

/// Pa: the shear stress at which flow begins to move grains, theta_cr (rho_s - rho) g d with Shields' parameter
/// theta_cr = 0.30 / (1 + 1.2 D*) + 0.055 (1 - exp(-0.020 D*)) (Soulsby & Whitehouse, "Threshold of sediment motion in
/// coastal environments", 1997). The grains must be heavier than the fluid.
[[nodiscard]] double shields_threshold(const Grains& grains);

/// Of each place (m) in a solid: its strength by noise, from 1 / erosion.strength_contrast to
/// erosion.strength_contrast.
[[nodiscard]] std::vector<float> strengths(const Erodibility& erosion, std::span<const glm::vec3> positions,
                                           std::uint64_t seed);

/// What hydraulic erosion needs of a scene and its particles at the start; nothing where no solid erodes. Throws Input
/// where strength comes from colors that there are not.
[[nodiscard]] std::optional<sim::HydraulicSettings> hydraulic_settings(const Scene& scene,
                                                                       const ParticleSet& particles);

} // namespace meltpoint
