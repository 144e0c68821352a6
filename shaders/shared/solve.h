// The iterative solves of incompressible fluids: what a solve is asked, and what it leaves. Written by the device, so that a
// solve ends when its error target is met without the host: the dispatches of an iteration take their workgroups from here.
#ifndef MELTPOINT_SHARED_SOLVE_H
#define MELTPOINT_SHARED_SOLVE_H
#include "prelude.h"

SHARED_BEGIN

// What is solved for (Bender & Koschier 2015): velocities that keep the density, or that bring it back to rest density.
SHARED_CONSTANT uint SOLVE_DIVERGENCE = 0u;
SHARED_CONSTANT uint SOLVE_DENSITY = 1u;
SHARED_CONSTANT uint SOLVES = 2u;

// Particles of free surfaces may come together: there is divergence to resist only from this part of rest density on.
SHARED_CONSTANT float DIVERGENCE_FILL = 0.9f;

// The part of the last step's pressures that a solve starts from (Bender & Koschier 2017). With all of them it needs fewer
// iterations yet, but still water trembles: 5e-5 of m g h in motion instead of 1e-7.
SHARED_CONSTANT float WARM_START = 0.5f;

// The part of a density above rest density that one step's density solve takes away. All of it in a short step would be a kick:
// an excess of 1 % of a spacing's density, taken away in 1e-7 s, throws fluid apart at tens of m/s. So it has correction_time.
SHARED_FUNCTION float density_share(float dt, float correction_time)
{
    return dt < correction_time ? dt / correction_time : 1.0f;
}

// How far an iterate goes on beyond the step that led to it, in parts of that step (Nesterov 1983), n iterations after the error
// has last risen, where it starts anew (O'Donoghue & Candes 2015).
SHARED_FUNCTION float solve_momentum(uint n) { return float(n) / float(n + 3u); }

// Which pass of a solve this is.
struct ResidualPush {
    uint solve;     // SOLVE_*
    uint iteration; // 0: the warm start
};

// One solve's state. `error` is the mean over fluid particles of max(rho*/rho0 - 1, 0), rho* the density that the
// velocities lead to within the step, or within correction_time where that is longer; of the divergence solve, the mean of
// max(dt drho/dt / rho0, 0).
struct Solve {
    uvec3 groups;           // workgroups of the next iteration's passes: (0, 0, 0) once the solve has ended
    uint iterations;        // of the last solve
    float error;            // of the last iterate
    float worst_error;      // that any left since the host last asked
    uint total_iterations;  // since the host last asked
    uint unrisen;           // iterations since the error has last risen
    uint arrived;           // workgroups of the present pass that are done
    uint unconverged;       // solves that ended at the maximum of iterations since the host last asked
    uint farthest;          // of solves that move particles: bits of the largest squared move in m^2 since the host last asked
    uint capped;            // likewise: particles, counted in each step, that were slowed down to the speed cap
};

SHARED_END
#endif
