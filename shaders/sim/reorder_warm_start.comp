#version 460
#extension GL_GOOGLE_include_directive : require
// Moves the warm starts of the solves into the sorted order, as reorder does with the particles.
#include "include/invocation.glsl"
#include "shared/sph_params.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 2, scalar) readonly buffer WarmStart { vec2 warm_start[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer SortedWarmStart { vec2 sorted_warm_start[]; };

void main()
{
    uint slot = invocation_index();
    if (slot < params.moving_count) {
        sorted_warm_start[slot] = warm_start[order[slot]];
    }
}
