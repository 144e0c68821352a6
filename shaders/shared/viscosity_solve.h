// The solve for what viscosity does within a step, taken at the step's end (Weiler, Koschier, Brand & Bender 2018):
// velocities v with m v + dt K v = m v*, where v* are the velocities before it and -K v the viscous forces. Each pair
// of fluid particles is pulled along its line, so that rigid rotation costs nothing and a free surface is free of
// stress; walls and colliders drag as they do where viscosity is a force like the others. K is symmetric and positive,
// so conjugate gradients (Hestenes & Stiefel 1952) find v, preconditioned with the blocks of the particles. All vectors
// are velocities: A v = v + dt K v / m.
#ifndef MELTPOINT_SHARED_VISCOSITY_SOLVE_H
#define MELTPOINT_SHARED_VISCOSITY_SOLVE_H
#include "prelude.h"
#include "solve.h"

SHARED_BEGIN

// A change of velocity by less than this part of the velocity is as good as none: the error is not measured against
// less.
SHARED_CONSTANT float VISCOSITY_CHANGE_FLOOR = 1e-4f;

// The solve's state. Its `error` is that of the viscous forces: of momenta, root mean squares by mass, that which is
// left over that which viscosity has changed.
struct ViscositySolve {
    Solve solve;    // first: the dispatches of an iteration take their workgroups from its start
    float advance;  // alpha of the present iteration
    float turn;     // beta: how much of the direction before stays in the next one
    float residual; // of the present iterate, sum m r . z, z the preconditioned residual
    float momentum; // sum m v*^2
};

// The inverse of a particle's block of A, symmetric.
struct ViscosityBlock {
    vec3 diagonal;
    vec3 off_diagonal; // yz, zx, xy
};

SHARED_END
#endif
