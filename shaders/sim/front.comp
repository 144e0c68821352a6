#version 460
#extension GL_GOOGLE_include_directive : require
// Solid particles that a front has reached turn into fluid: they keep their place, velocity, mass and material, and from now on
// forces move them. Those that crumble turn into dust, which no fluid feels. Twin: engine/reference/erosion.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/pool_changes.h"
#include "shared/sph_params.h"

layout(push_constant, scalar) uniform Push { float time; }; // s
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 2, scalar) readonly buffer ReleaseTime { float release_time[]; }; // by id, s
layout(set = 0, binding = 3, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 4, scalar) buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 5, scalar) buffer Position { vec4 position[]; };         // w: weight
layout(set = 0, binding = 6, scalar) buffer Changes { PoolChanges changes; };

#include "include/freed.glsl"

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count || particle_state(attributes[i]) != STATE_SOLID || time < release_time[id[i]]) {
        return;
    }
    bool crumbles = (attributes[i] & FLAG_CRUMBLES) != 0u;
    attributes[i] = freed_as(attributes[i], crumbles ? STATE_DUST : STATE_FLUID, CAUSE_FRONT);
    velocity[i].w = crumbles ? velocity[i].w : abs(velocity[i].w);
    position[i].w = crumbles ? 0.0 : position[i].w;
    count_freed(i);
}
