#version 460
#extension GL_GOOGLE_include_directive : require
// Solid particles whose latent heat is complete turn into fluid: they keep their place, velocity, mass, material and enthalpy. Each
// does at the look that is nearest to its time, if heat goes on to come as it did: what one gets beyond that is lost to the next one.
// Twin: engine/reference/melting.cpp.
#include "include/invocation.glsl"
#include "shared/heat.h"
#include "shared/melting.h"
#include "shared/particle_state.h"
#include "shared/pool_changes.h"

layout(push_constant, scalar) uniform Push { MeltPush push; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform Heat { HeatParams heat; };
layout(set = 0, binding = 2, scalar) uniform Melting { MeltingParams melting; };
layout(set = 0, binding = 3, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Enthalpy { vec2 enthalpy[]; }; // by id, two-floats
layout(set = 0, binding = 5, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 6, scalar) buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 7, scalar) writeonly buffer ReleaseTime { float release_time[]; }; // by id, s
layout(set = 0, binding = 8, scalar) buffer Changes { PoolChanges changes; };
layout(set = 0, binding = 9, scalar) buffer Before { float before[]; }; // enthalpy at the last look, by id

#include "include/freed.glsl"

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count || particle_state(attributes[i]) != STATE_SOLID) {
        return;
    }
    uint material = particle_material(attributes[i]);
    float now = enthalpy[id[i]].x;
    float gain = max(now - before[id[i]], 0.0);
    before[id[i]] = now;
    if (melting.melts[material] != 0u && now + push.ahead * gain >= heat.of[material].latent_heat) {
        attributes[i] = freed_as(attributes[i], STATE_FLUID, CAUSE_MELT);
        velocity[i].w = abs(velocity[i].w);
        release_time[id[i]] = push.time;
        count_freed(i);
    }
}
