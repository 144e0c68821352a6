#version 460
#extension GL_GOOGLE_include_directive : require
// A round of the search for pieces, first half: a solid particle takes on the smallest name among those that it is connected to, and
// hands it on to the one that its old name belongs to (hooking, after Shiloach & Vishkin, J. Algorithms 3, 1982). Names only ever get
// smaller, and in the end a piece has its smallest id, in whatever order that happens. Anchored solids are connected to anchored
// ones, loose ones to those of their own body or to what has just frozen to it. Twin: engine/reference/fragments.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/rigid.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer CellStart { uint cell_start[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Position { vec4 position[]; }; // w: weight
layout(set = 0, binding = 5) uniform textureBuffer position_texels;
layout(set = 0, binding = 6, scalar) readonly buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 7) uniform textureBuffer velocity_texels;
layout(set = 0, binding = 8, scalar) readonly buffer BodyOf { uint body_of[]; }; // by id
layout(set = 0, binding = 9, scalar) coherent buffer Label { uint label[]; };    // by id
layout(set = 0, binding = 10, scalar) buffer Changes { PieceChanges changes; };

#include "include/near_walk.glsl"

// Dust has no weight and colliders have no mass.
bool is_solid(uint j) { return load_candidate(position, j).w > 0.0 && load_candidate(velocity, j).w < 0.0; }

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count || particle_state(attributes[i]) != STATE_SOLID) {
        return;
    }
    uint own_id = id[i];
    uint own = label[own_id];
    uint body = body_of[own_id];
    vec3 x = position[i].xyz;
    float reach = BOND_DISTANCE * params.spacing;
    int table = is_loose(attributes[i]) ? 0 : still_table();
    uint smallest = own;
    uint all = shift_axes(x, reach);
    FOR_EACH_SHIFT(axes, all) {
        NearWalk walk = near_walk(shifted(x, axes), reach, table);
        FOR_EACH_NEAR(j, walk) {
            uint its_body = body_of[id[j]];
            bool is_bonded = is_solid(j) && (its_body == body || its_body == NO_BODY || body == NO_BODY);
            smallest = is_bonded ? min(smallest, label[id[j]]) : smallest;
        }
    }
    if (smallest < own) {
        atomicMin(label[own], smallest);
        atomicMin(label[own_id], smallest);
        atomicAdd(changes.unsettled, 1u);
    }
}
