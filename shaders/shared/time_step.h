// The time step, chosen on the device: as long as stability allows, and so that the last one ends where the host wants it.
#ifndef MELTPOINT_SHARED_TIME_STEP_H
#define MELTPOINT_SHARED_TIME_STEP_H
#include "prelude.h"

SHARED_BEGIN

// No step is longer than this times what the one before might have been: fluid that is suddenly slow gets time to settle.
SHARED_CONSTANT float TIME_STEP_GROWTH = 1.1f;

// A step may be longer than its limit by this, relative: rounding of what remains must not cost one more step.
SHARED_CONSTANT float LANDING_TOLERANCE = 1e-5f;

SHARED_CONSTANT uint PARTICLES_PER_SPEED = 16u; // that one invocation looks at for the fastest

// The state of the time steps, one on the device.
struct TimeStep {
    uint fastest;    // bits of the largest squared speed in m^2/s^2; floats that are not negative sort like their bits
    float limit;     // s: the last step might have been this long
    float remaining; // s, until the time that the host wants to see
    float elapsed;   // s, since the host last set `remaining`
};

// The longest of the equal steps, none longer than a limit, that lead to the end of what remains. Were only the last ones cut,
// pressure solved for there would not be that of the others.
SHARED_FUNCTION float landing_step(float limit, float remaining)
{
    float steps = remaining / (limit * (1.0f + LANDING_TOLERANCE));
    if (steps <= 1.0f) {
        return remaining;
    }
    return steps < 1e6f ? remaining / float(uint(steps) + 1u) : limit;
}

SHARED_END
#endif
