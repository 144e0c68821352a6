#version 460
#extension GL_GOOGLE_include_directive : require
// Sand that has come down, and whose place on its column it is, is solid there, unless fluid is in that place: it would be thrown
// out. It lies among the moving ones yet. Twin: engine/reference/wind.cpp.
#include "include/candidate.glsl"
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
layout(set = 0, binding = 8, scalar) buffer Rests { uint rests[]; };           // by id
layout(set = 0, binding = 9, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 10, scalar) buffer Position { vec4 position[]; }; // w: weight
layout(set = 0, binding = 11, scalar) buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 12, scalar) buffer Changes { PoolChanges changes; };
layout(set = 0, binding = 13, scalar) readonly buffer CellStart { uint cell_start[]; };
layout(set = 0, binding = 14) uniform textureBuffer position_texels;

#include "include/ground.glsl"
#include "include/columns.glsl"
#include "include/near_walk.glsl"

// Since it was sorted, fluid may have moved on by a part of a spacing: the walk goes so much farther.
bool holds_fluid(vec3 x)
{
    bool found = false;
    uint all = shift_axes(x, params.spacing);
    FOR_EACH_SHIFT(axes, all) {
        vec3 place = shifted(x, axes);
        NearWalk walk = near_walk(place, 1.5 * params.spacing, 0);
        FOR_EACH_NEAR(j, walk) {
            bool is_fluid = velocity[j].w > 0.0 && load_candidate(position, j).w > 0.0;
            found = found || (is_fluid && distance(load_candidate(position, j).xyz, place) < ROOM_TO_LAND * params.spacing);
        }
    }
    return found;
}

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count || !is_flying_sand(attributes[i]) || rests[id[i]] == 0u) {
        return;
    }
    ivec2 here = texel_at(position[i].xyz);
    if (claim[index_of(here)] != id[i]) {
        return;
    }
    vec3 place = place_in_column(here, next_height(here));
    if (holds_fluid(place)) {
        return;
    }
    rests[id[i]] = 0u;
    attributes[i] = with_state(attributes[i], STATE_SOLID);
    position[i] = vec4(place, 1.0);
    velocity[i].xyz = vec3(0.0);
    atomicAdd(changes.deposited, 1u);
}
