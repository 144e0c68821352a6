#version 460
#extension GL_GOOGLE_include_directive : require
// The next step's length: the CFL bound of the fastest particle, no longer than params.longest_dt, no shorter than params.shortest_dt,
// not much longer than the step before, and landing on the time that the host wants to see. One invocation. Twin: engine/reference/time_step.cpp.
#include "include/invocation.glsl"
#include "shared/sph_params.h"
#include "shared/time_step.h"

layout(set = 0, binding = 0, scalar) buffer Params { SphParams params; };
layout(set = 0, binding = 1, scalar) buffer Step { TimeStep step; };

void main()
{
    if (invocation_index() > 0u) {
        return;
    }
    float speed = params.cfl_speed + sqrt(uintBitsToFloat(step.fastest));
    float limit = min(params.longest_dt, step.limit * TIME_STEP_GROWTH);
    limit = limit * speed > params.cfl_length ? params.cfl_length / speed : limit;
    limit = max(limit, params.shortest_dt);
    float dt = landing_step(limit, step.remaining);
    params.dt = dt;
    params.speed_limit = params.longest_move / dt;
    step = TimeStep(0u, limit, step.remaining - dt, step.elapsed + dt);
}
