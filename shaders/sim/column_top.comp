#version 460
#extension GL_GOOGLE_include_directive : require
// Of each column that is seen from above, who of the solids in it is its top: the one of smallest id where they are equally high.
// Twin: engine/reference/wind.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/sph_params.h"
#include "shared/visibility.h"
#include "shared/wind.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform Wind { WindParams wind; };
layout(set = 0, binding = 2, scalar) uniform View { VisibilityParams view; }; // from above
layout(set = 0, binding = 3, scalar) readonly buffer GroundBuffer { vec4 ground[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 7, scalar) readonly buffer Map { uint map[]; };
layout(set = 0, binding = 8, scalar) buffer TopId { uint top_id[]; };

#include "include/ground.glsl"
#include "include/visibility.glsl"

void main()
{
    uint i = params.moving_count + invocation_index();
    if (i >= params.pool_count || particle_state(attributes[i]) != STATE_SOLID) {
        return;
    }
    uint texel = index_of(texel_at(position[i].xyz));
    if (depth_of(position[i].xyz) == map[texel]) {
        atomicMin(top_id[texel], id[i]);
    }
}
