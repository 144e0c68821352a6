#version 460
#extension GL_GOOGLE_include_directive : require
// v += a dt times a part: half a step as the second half of velocity Verlet, or a whole one. Twin:
// engine/reference/integrate.cpp.
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "shared/sph_params.h"

layout(push_constant, scalar) uniform Push { float part; }; // of the step
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Acceleration { vec4 acceleration[]; };
layout(set = 0, binding = 2) uniform textureBuffer acceleration_texels;
layout(set = 0, binding = 3, scalar) buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 4) uniform textureBuffer velocity_texels;

void main()
{
    uint i = invocation_index();
    if (i < params.moving_count) {
        velocity[i].xyz = load_candidate(velocity, i).xyz + part * params.dt * load_candidate(acceleration, i).xyz;
    }
}
