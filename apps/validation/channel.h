#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "validation/case.h"

namespace meltpoint::validation {

/// Fluid between two plates L = 1 mm apart, periodic along them, U L/nu = 0.0125 (Morris, Fox & Zhu 1997: water, U =
/// 1.25e-5 m/s): driven by a body force that makes it U fast in the middle (Poiseuille), or by the upper plate, which
/// moves at U (Couette). wcsph, H = 3 d.
struct Channel {
    std::uint32_t across = 50;     ///< particles
    bool couette = false;          ///< the plate drives it
    bool implicit = true;          ///< viscosity is solved for
    double viscosity_factor = 1.0; ///< the fluid's over the exact solution's: for what shall go wrong
    double drive_factor = 1.0;     ///< the force's, or the plate's speed, likewise
};

struct ChannelFlow {
    double error = 0.0;                             ///< largest difference to the exact profile, over U
    std::uint32_t unconverged = 0;                  ///< solves for viscosity
    std::vector<std::pair<double, double>> profile; ///< y/L, and velocity/U
};

/// Once the flow is steady.
[[nodiscard]] ChannelFlow measure_channel(const Host& host, const Channel& channel);

} // namespace meltpoint::validation
