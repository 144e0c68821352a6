#version 460
#extension GL_GOOGLE_include_directive : require
// Those whom land.comp has found room for are solid. They lie among the moving ones yet. Twin: engine/reference/wind.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/pool_changes.h"
#include "shared/sph_params.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 2, scalar) buffer Lands { uint lands[]; }; // by id
layout(set = 0, binding = 3, scalar) buffer Rests { uint rests[]; }; // by id
layout(set = 0, binding = 4, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 5, scalar) buffer Position { vec4 position[]; }; // w: weight
layout(set = 0, binding = 6, scalar) buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 7, scalar) buffer Changes { PoolChanges changes; };

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count || lands[id[i]] == 0u) {
        return;
    }
    lands[id[i]] = 0u;
    rests[id[i]] = 0u;
    attributes[i] = with_state(attributes[i], STATE_SOLID);
    position[i].w = 1.0;
    velocity[i].xyz = vec3(0.0);
    atomicAdd(changes.deposited, 1u);
}
