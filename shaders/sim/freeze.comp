#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Fluid that has no latent heat left is solid where a solid, or a collider, is near: it stops there. They lie among the moving
// ones yet. Twin: engine/reference/melting.cpp.
#define CELL_START_BINDING 1
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "shared/melting.h"
#include "shared/particle_state.h"
#include "shared/pool_changes.h"
#include "shared/rigid.h"

layout(push_constant, scalar) uniform Push { uint any_loose; }; // whether there are loose solids
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) uniform Melting { MeltingParams melting; };
layout(set = 0, binding = 3, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Enthalpy { vec2 enthalpy[]; }; // by id, two-floats
layout(set = 0, binding = 5, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 6, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 7, scalar) buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 8, scalar) writeonly buffer ReleaseTime { float release_time[]; }; // by id, s
layout(set = 0, binding = 9, scalar) buffer Changes { PoolChanges changes; };
layout(set = 0, binding = 10, scalar) readonly buffer BodyOf { uint body_of[]; }; // by id; of no meaning where none are loose

// Whether a solid or collider is near, among the still ones or, of those in bodies, the moving ones. Who freezes in this very pass
// is of no body.
bool touches_solid(vec3 x, bool still)
{
    vec3 walking[TILE]; // a walk is that of a tile
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        walking[k] = k == 0u ? x : NOWHERE;
    }
    float reach = FREEZING_DISTANCE * params.spacing;
    bool found = false;
    Walk walk = begin_walk(walking, params.domain_min, params.support_radius, params.grid_size);
    walk.table = still ? int(params.grid_size.x * params.grid_size.y * params.grid_size.z) : 0;
    FOR_EACH_CANDIDATE(range, walk) {
        vec3 offset = x - position[range.x].xyz;
        bool is_solid = still ? is_still(attributes[range.x]) : body_of[id[range.x]] != NO_BODY;
        found = found || (is_solid && dot(offset, offset) < reach * reach);
    }
    return found;
}

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count || particle_state(attributes[i]) != STATE_FLUID || enthalpy[id[i]].x > 0.0) {
        return;
    }
    bool at_still = touches_solid(position[i].xyz, true);
    bool at_loose = !at_still && any_loose != 0u && touches_solid(position[i].xyz, false);
    if (at_still || at_loose) {
        attributes[i] = with_state(attributes[i], STATE_SOLID) | (at_loose ? FLAG_LOOSE : 0u);
        velocity[i] = vec4(at_loose ? velocity[i].xyz : vec3(0.0), -abs(velocity[i].w)); // the body takes its momentum
        release_time[id[i]] = uintBitsToFloat(0x7f800000u); // no front is on its way to it
        atomicAdd(changes.frozen, at_loose ? 0u : 1u);
        atomicAdd(changes.frozen_loose, at_loose ? 1u : 0u);
    }
}
