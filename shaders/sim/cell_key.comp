#version 460
#extension GL_GOOGLE_include_directive : require
// The grid cell of every moving particle: the key of the counting sort. Twin: engine/reference/cells.cpp.
#include "include/candidate.glsl"
#include "include/grid.glsl"
#include "include/invocation.glsl"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 2) uniform textureBuffer position_texels;
layout(set = 0, binding = 3, scalar) writeonly buffer Key { uint key[]; };

void main()
{
    uint i = invocation_index();
    if (i < params.moving_count) {
        key[i] = cell_of(load_candidate(position, i).xyz, params.domain_min, params.support_radius, params.grid_size);
    }
}
