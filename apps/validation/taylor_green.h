#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "validation/case.h"

namespace meltpoint::validation {

/// Vortices that viscosity alone wears away (Taylor & Green 1937): in a square of side L, periodic,
/// v = U (sin kx cos ky, -cos kx sin ky), k = 2 pi/L, dies as exp(-2 k^2 nu t), that is, exp(-8 pi^2 nu t/L^2).
/// U L/nu = 100, wcsph, H = 3 d.
struct TaylorGreen {
    std::uint32_t across = 100;    ///< particles
    float shifting = 5.0f;         ///< as physics.shifting
    double viscosity_factor = 1.0; ///< the fluid's viscosity over the exact solution's: for what shall go wrong
};

struct Decay {
    double rate = 0.0;                            ///< of the velocity, over the exact one
    std::vector<std::pair<double, double>> speed; ///< t U/L, and the root mean square velocity over the first
};

/// From `first` to `last` in times L/U: at the start a lattice still becomes a fluid.
[[nodiscard]] Decay measure_decay(const Host& host, const TaylorGreen& flow, double first = 0.1, double last = 1.0);

} // namespace meltpoint::validation
