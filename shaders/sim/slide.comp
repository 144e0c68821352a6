#version 460
#extension GL_GOOGLE_include_directive : require
// The top of a column of sand that is too steep is to slide to the lowest column beside it, for its distance, and says so there.
// The place on a column is for the one of smallest id; nobody moves yet: slide_apply.comp moves them. Twin:
// engine/reference/wind.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/sph_params.h"
#include "shared/visibility.h"
#include "shared/wind.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform Wind { WindParams wind; };
layout(set = 0, binding = 2, scalar) uniform View { VisibilityParams view; };
layout(set = 0, binding = 3, scalar) readonly buffer GroundBuffer { vec4 ground[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 7, scalar) readonly buffer TopId { uint top_id[]; }; // of each texel
layout(set = 0, binding = 8, scalar) writeonly buffer Way { uint way[]; };     // likewise
layout(set = 0, binding = 9, scalar) buffer Claim { uint claim[]; };           // likewise: the smallest id that is to come there

#include "include/ground.glsl"

void main()
{
    uint i = params.moving_count + invocation_index();
    if (i >= params.pool_count || particle_state(attributes[i]) != STATE_SOLID) {
        return;
    }
    WindMaterial sand = wind.of[particle_material(attributes[i])];
    ivec2 here = texel_at(position[i].xyz);
    if (sand.erodes == 0u || top_id[index_of(here)] != id[i]) {
        return;
    }
    WayDown down = way_down(here, ground_at(here).top, id[i], sand.steepest, STEEPEST_STEP);
    if (down.way == WAY_NONE) {
        return;
    }
    bool falls = down.drop > HIGHEST_SLIDE;
    way[index_of(here)] = down.way + (falls ? WAY_FALLS : 0u);
    if (!falls) {
        atomicMin(claim[index_of(neighbor_of(here, down.way))], id[i]);
    }
}
