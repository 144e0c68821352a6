#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "scene/scene.h"
#include "validation/case.h"

namespace meltpoint::validation {

/// A drop of water, 1 mm in radius, without weight.
struct DropSettings {
    double radius = 10.0; ///< in spacings
    std::uint32_t dimensions = 3;
    Solver solver = Solver::Wcsph;
    float support_ratio = 2.0f;
    double tension_factor = 1.0; ///< the fluid's over the exact solution's: for what shall go wrong
};

/// The pressure inside a drop at rest over what Laplace (1806) says, sigma/R of each principal curvature. R is that of
/// the water's volume. Mean of particles deeper than the kernels reach, over the last third of three times
/// sqrt(rho R^3/sigma), of a fluid thick enough to come to rest.
[[nodiscard]] double measure_laplace(const Host& host, const DropSettings& settings);

/// A drop drawn out by a tenth and let go.
struct DropSwing {
    double period = 0.0;                            ///< over Rayleigh's
    std::vector<std::pair<double, double>> stretch; ///< time in Rayleigh's periods; length over width, less 1
};
/// For one and a half periods: 2 pi/omega, omega^2 = 8 sigma/(rho R^3), in two dimensions 6 (Rayleigh 1879, Lamb 1932).
[[nodiscard]] DropSwing measure_swing(const Host& host, const DropSettings& settings);

/// Water on the domain's floor.
struct ContactSettings {
    float angle = 90.0f;  ///< degrees
    double across = 16.0; ///< width of the block of water that it starts as, in spacings
};
/// The angle that the block has come to, in degrees: of the spherical cap of its volume and height.
[[nodiscard]] double measure_contact_angle(const Host& host, const ContactSettings& settings);

} // namespace meltpoint::validation
