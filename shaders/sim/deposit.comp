#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Sediment that is slow and rests on something heals, and is solid again once it is whole (shared/hydraulic.h). It lies among the
// moving ones yet. Twin: engine/reference/hydraulic.cpp.
#define CELL_START_BINDING 1
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "shared/hydraulic.h"
#include "shared/particle_state.h"
#include "shared/pool_changes.h"
#include "shared/two_float.h"

layout(push_constant, scalar) uniform Push { float seconds; }; // since the last look
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) uniform Hydraulic { HydraulicParams hydraulic; };
layout(set = 0, binding = 3, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 5, scalar) buffer Damage { vec2 damage[]; }; // by id, two-floats
layout(set = 0, binding = 6, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 7, scalar) buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 8, scalar) writeonly buffer ReleaseTime { float release_time[]; }; // by id, s
layout(set = 0, binding = 9, scalar) buffer Changes { PoolChanges changes; };
layout(set = 0, binding = 10, scalar) readonly buffer Density { float density[]; };

// Whether the way to what is there leads down; where there is no gravity, every way does.
bool is_below(vec3 way) { return dot(way, params.gravity) >= RESTING_COSINE * length(way) * length(params.gravity); }

bool rests_on_floor(vec3 x)
{
    float reach = params.spacing; // half of it is where a lattice begins
    bool rests = false;
    [[unroll]] for (uint axis = 0u; axis < 3u; ++axis) {
        vec3 down = vec3(0.0);
        down[axis] = -1.0;
        bool low = (params.wall_mask & (1u << (2u * axis))) != 0u && x[axis] - params.domain_min[axis] < reach;
        bool high = (params.wall_mask & (2u << (2u * axis))) != 0u && params.domain_max[axis] - x[axis] < reach;
        rests = rests || (low && is_below(down)) || (high && is_below(-down));
    }
    return rests;
}

bool rests_on_solid(vec3 x)
{
    vec3 walking[TILE]; // a walk is that of a tile
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        walking[k] = k == 0u ? x : NOWHERE;
    }
    float reach = RESTING_DISTANCE * params.spacing;
    bool rests = false;
    Walk walk = begin_walk(walking, params.domain_min, params.support_radius, params.grid_size);
    walk.table = int(params.grid_size.x * params.grid_size.y * params.grid_size.z); // of the still ones alone
    FOR_EACH_CANDIDATE(range, walk) {
        vec3 way = position[range.x].xyz - x;
        rests = rests || (is_still(attributes[range.x]) && dot(way, way) < reach * reach && is_below(way));
    }
    return rests;
}

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count || particle_state(attributes[i]) != STATE_FLUID ||
        cause_of(attributes[i]) != CAUSE_HYDRAULIC || hydraulic.deposits[particle_material(attributes[i])] == 0u) {
        return;
    }
    uint slot = id[i];
    vec3 x = position[i].xyz;
    bool has_room = density[i] < MOST_CROWDED * params.rest_density[particle_material(attributes[i])];
    bool rests = has_room && length(velocity[i].xyz) < hydraulic.deposition_speed && (rests_on_floor(x) || rests_on_solid(x));
    vec2 left = rests ? two_float_add(damage[slot], -seconds / hydraulic.deposition_time) : vec2(1.0, 0.0);
    bool is_whole = left.x <= 0.0;
    damage[slot] = is_whole ? vec2(0.0) : left;
    if (is_whole) {
        attributes[i] = with_state(attributes[i], STATE_SOLID);
        velocity[i] = vec4(vec3(0.0), -abs(velocity[i].w));
        release_time[slot] = uintBitsToFloat(0x7f800000u); // no front is on its way to it
        atomicAdd(changes.deposited, 1u);
    }
}
