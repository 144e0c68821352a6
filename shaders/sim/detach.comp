#version 460
#extension GL_GOOGLE_include_directive : require
// Solid particles that flow has worn away are free: fluid of their own material, at the place where they were and with the same
// mass (shared/hydraulic.h). Each goes at the look that is nearest to its time, half of them a little early: to wait for the look
// after it would make every layer late. Twin: engine/reference/hydraulic.cpp.
#include "include/invocation.glsl"
#include "shared/hydraulic.h"
#include "shared/particle_state.h"
#include "shared/pool_changes.h"

layout(push_constant, scalar) uniform Push { DetachPush push; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform Hydraulic { HydraulicParams hydraulic; };
layout(set = 0, binding = 2, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 3, scalar) buffer Damage { vec2 damage[]; }; // by id, two-floats
layout(set = 0, binding = 4, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 5, scalar) buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 6, scalar) writeonly buffer ReleaseTime { float release_time[]; }; // by id, s
layout(set = 0, binding = 7, scalar) buffer Changes { PoolChanges changes; };
layout(set = 0, binding = 8, scalar) readonly buffer Rate { float rate[]; }; // by id, 1/s

#include "include/freed.glsl"

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count || particle_state(attributes[i]) != STATE_SOLID) {
        return;
    }
    uint slot = id[i];
    bool is_due = damage[slot].x + rate[slot] * push.ahead >= 1.0;
    if (hydraulic.erodes[particle_material(attributes[i])] != 0u && is_due) {
        damage[slot] = vec2(1.0, 0.0);
        attributes[i] = freed_as(attributes[i], STATE_FLUID, CAUSE_HYDRAULIC);
        velocity[i].w = abs(velocity[i].w);
        release_time[slot] = push.time;
        count_freed(i);
    }
}
