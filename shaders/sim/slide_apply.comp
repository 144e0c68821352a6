#version 460
#extension GL_GOOGLE_include_directive : require
// The tops of columns that slide.comp has found a way for move: by a spacing, on top of the column beside their own where it is
// for them to be, or into the air above it, to fall. Twin: engine/reference/wind.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/pool_changes.h"
#include "shared/sph_params.h"
#include "shared/visibility.h"
#include "shared/wind.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform Wind { WindParams wind; };
layout(set = 0, binding = 2, scalar) uniform View { VisibilityParams view; };
layout(set = 0, binding = 3, scalar) readonly buffer GroundBuffer { vec4 ground[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 5, scalar) readonly buffer TopId { uint top_id[]; }; // of each texel
layout(set = 0, binding = 6, scalar) readonly buffer Way { uint way[]; };      // likewise
layout(set = 0, binding = 7, scalar) readonly buffer Claim { uint claim[]; };  // likewise
layout(set = 0, binding = 8, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 9, scalar) buffer Position { vec4 position[]; }; // w: weight
layout(set = 0, binding = 10, scalar) buffer Changes { PoolChanges changes; };

#include "include/ground.glsl"
#include "include/columns.glsl"

void main()
{
    uint i = params.moving_count + invocation_index();
    if (i >= params.pool_count || particle_state(attributes[i]) != STATE_SOLID) {
        return;
    }
    ivec2 here = texel_at(position[i].xyz);
    uint its_way = way[index_of(here)];
    if (top_id[index_of(here)] != id[i] || its_way == WAY_NONE) {
        return;
    }
    ivec2 there = end_of_way(here, its_way);
    if (its_way >= WAY_FALLS) {
        attributes[i] = freed_as(attributes[i], STATE_DUST, CAUSE_WIND); // at rest, as solids are
        position[i] = vec4(place_in_column(there, ground_at(here).top), 0.0);
        atomicAdd(changes.freed, 1u);
    } else if (claim[index_of(there)] == id[i]) {
        position[i].xyz = place_in_column(there, next_height(there));
        atomicAdd(changes.slid, 1u);
    }
}
