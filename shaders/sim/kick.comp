#version 460
#extension GL_GOOGLE_include_directive : require
// Second half of velocity Verlet: v += a dt/2 with the new acceleration. Twin: engine/reference/integrate.cpp.
#include "include/invocation.glsl"
#include "shared/sph_params.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Acceleration { vec4 acceleration[]; };
layout(set = 0, binding = 2, scalar) buffer Velocity { vec4 velocity[]; };

void main()
{
    uint i = invocation_index();
    if (i < params.particle_count) {
        velocity[i].xyz += 0.5 * params.dt * acceleration[i].xyz;
    }
}
