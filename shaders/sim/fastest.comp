#version 460
#extension GL_GOOGLE_include_directive : require
// The largest speed that a particle has or will have after a step like the last one. Twin: engine/reference/time_step.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/sph_params.h"
#include "shared/time_step.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Acceleration { vec4 acceleration[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 4, scalar) buffer Step { TimeStep step; };

void main()
{
    uint stride = (params.moving_count + PARTICLES_PER_SPEED - 1u) / PARTICLES_PER_SPEED;
    uint first = invocation_index();
    if (first >= stride) {
        return;
    }
    float fastest = 0.0;
    for (uint i = first; i < params.moving_count; i += stride) {
        vec3 v = velocity[i].xyz;
        vec3 later = v + params.dt * acceleration[i].xyz;
        float speed2 = max(dot(v, v), dot(later, later));
        bool counts = !is_boundary(attributes[i]) || is_loose(attributes[i]);
        fastest = counts ? max(fastest, speed2) : fastest;
    }
    atomicMax(step.fastest, floatBitsToUint(fastest));
}
