#version 460
#extension GL_GOOGLE_include_directive : require
// Second half of velocity Verlet: v += a dt/2 with the new acceleration. Twin: engine/reference/integrate.cpp.
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "shared/sph_params.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Acceleration { vec4 acceleration[]; };
layout(set = 0, binding = 2) uniform textureBuffer acceleration_texels;
layout(set = 0, binding = 3, scalar) buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 4) uniform textureBuffer velocity_texels;

void main()
{
    uint i = invocation_index();
    if (i < params.particle_count) {
        velocity[i].xyz = load_candidate(velocity, i).xyz + 0.5 * params.dt * load_candidate(acceleration, i).xyz;
    }
}
