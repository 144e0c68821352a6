#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "scene/scene.h"
#include "validation/case.h"

namespace meltpoint::validation {

/// Fluid that touches no wall.
struct FreeMotion {
    Solver solver = Solver::Wcsph;
    std::uint32_t across = 8;    ///< particles of a block or a drop
    double gravity_factor = 1.0; ///< the fluid's over the exact solution's: for what shall go wrong
};

/// A block of water let go, 0.3 s later.
struct Fall {
    double place = 0.0;                            ///< error of the center of mass, in parts of g t^2/2
    double speed = 0.0;                            ///< error of its velocity, in parts of g t
    double ahead = 0.0;                            ///< of its exact place, in the way of a step
    double steps = 0.0;                            ///< number of them
    std::vector<std::pair<double, double>> height; ///< t in s, and the way fallen in m
};
[[nodiscard]] Fall measure_fall(const Host& host, const FreeMotion& motion);

/// Two drops without viscosity that meet off their centers.
struct Encounter {
    double momentum = 0.0;         ///< its change, in parts of sum m |v|
    double angular_momentum = 0.0; ///< its change about the middle, in parts of sum m |x| |v|
    double exchanged = 0.0;        ///< sum m |change of v| in parts of sum m |v|: that they did meet
};
[[nodiscard]] Encounter measure_encounter(const Host& host, const FreeMotion& motion);

} // namespace meltpoint::validation
