#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// A viscosity solve ends: velocities with the change that it has found, which is kept as an acceleration for the next step to start
// from. Twin: engine/reference/viscosity.cpp.
#include "include/invocation.glsl"
#include "shared/sph_params.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) buffer Change { vec4 change[]; };
layout(set = 0, binding = 2, scalar) buffer Velocity { vec4 velocity[]; }; // w: mass

void main()
{
    uint i = invocation_index();
    if (i < params.moving_count) {
        vec3 u = change[i].xyz;
        velocity[i].xyz += u;
        change[i] = vec4(u / params.dt, 0.0);
    }
}
