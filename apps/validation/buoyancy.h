#pragma once

#include "gpu/context.h"
#include "scene/scene.h"

namespace meltpoint::validation {

/// A ball held under still water in a box, and what it weighs less than in the air.
struct Buoyancy {
    double measured = 0.0; ///< N, upward, mean over the last time
    double sideways = 0.0; ///< N, the largest of the other two components
    double torque = 0.0;   ///< N m
    double exact = 0.0;    ///< rho g V, N
};

/// radius: of the ball, in spacings. Blue noise, for a lattice at rest bears shear: it held up 10 % of a ball's lift.
///
/// First the water gets 0.3 s to close up around the ball. Then it is left swinging about its compressed state in a
/// standing wave of sound whose length is 4 h: after h/c0 it passes through rest position, and velocities taken away
/// there leave little. After some rounds of that, the mean over two periods counts.
[[nodiscard]] Buoyancy measure_buoyancy(const gpu::Context& context, Solver solver, double support_ratio, float radius,
                                        double measured_periods = 2.0);

} // namespace meltpoint::validation
