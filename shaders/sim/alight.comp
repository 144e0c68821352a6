#version 460
#extension GL_GOOGLE_include_directive : require
// Sand that has come down is to be the top of its column, and says so there (slide.comp): nobody is solid yet, land.comp makes it
// so. Where it would stand up like a tower, or beside a hole, it rolls on to the lowest column beside it. Twin: engine/reference/wind.cpp.
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
layout(set = 0, binding = 6, scalar) buffer Position { vec4 position[]; };
layout(set = 0, binding = 7, scalar) buffer Rests { uint rests[]; }; // by id: 1 where it has come down
layout(set = 0, binding = 8, scalar) buffer Claim { uint claim[]; }; // of each texel

#include "include/ground.glsl"

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count || !is_flying_sand(attributes[i]) || rests[id[i]] == 0u) {
        return;
    }
    ivec2 here = texel_at(position[i].xyz);
    float height = ground_at(here).top + params.spacing;
    bool is_gentle = length(ground_at(here).slope) < GENTLE_SLOPE; // there holes are filled
    WayDown down = way_down(here, height, id[i], ANY_SLOPE, is_gentle ? STEEPEST_STEP : STEEPEST_STEP + 1.0);
    if (down.way == WAY_NONE) {
        atomicMin(claim[index_of(here)], id[i]);
    } else {
        ivec2 there = neighbor_of(here, down.way);
        bool falls = down.drop > HIGHEST_SLIDE;
        position[i].xyz = place_in_column(there, falls ? height : ground_at(there).top + params.spacing);
        rests[id[i]] = falls ? 0u : 1u;
    }
}
