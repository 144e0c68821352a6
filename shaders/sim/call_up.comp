#version 460
#extension GL_GOOGLE_include_directive : require
// Calls up an emitter's dead slots for the births that are due before the next look (shared/emission.h): those of smallest id,
// in order of id, as long as there are some. Twin: engine/reference/emission.cpp.
#include "include/invocation.glsl"
#include "shared/emission.h"
#include "shared/particle_state.h"
#include "shared/pool_changes.h"
#include "shared/sph_params.h"

layout(push_constant, scalar) uniform Push { Call call; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Emitters { Emitter emitters[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Points { vec3 points[]; }; // m
layout(set = 0, binding = 3, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 4, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 5, scalar) buffer Position { vec4 position[]; };
layout(set = 0, binding = 6, scalar) buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer ReleaseTime { float release_time[]; }; // by id, s
layout(set = 0, binding = 8, scalar) buffer Changes { PoolChanges changes; };

// Place of the first of the dead whose id is no smaller.
uint first_dead_from(uint wanted)
{
    uint low = call.first_dead;
    uint high = params.pool_count;
    while (low < high) {
        uint middle = (low + high) / 2u;
        bool below = id[middle] < wanted;
        low = below ? middle + 1u : low;
        high = below ? high : middle;
    }
    return low;
}

void main()
{
    uint k = invocation_index();
    if (k >= call.births) {
        return;
    }
    Emitter emitter = emitters[call.emitter];
    uint i = first_dead_from(emitter.first_id) + k;
    if (i >= params.pool_count || id[i] >= emitter.first_id + emitter.slots) {
        return; // none is left
    }
    uint birth = call.first_birth + k;
    vec3 random = vec3(birth_random(emitter, birth, 0u), birth_random(emitter, birth, 1u), birth_random(emitter, birth, 2u));
    attributes[i] = attributes[i] | FLAG_DUE;
    position[i] = vec4(points[emitter.first_point + birth % emitter.points] + emitter.spread * random, 0.0);
    velocity[i].xyz = emitter.velocity;
    release_time[id[i]] = birth_time(emitter, birth);
    atomicAdd(changes.called[call.emitter], 1u);
}
