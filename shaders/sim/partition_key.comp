#version 460
#extension GL_GOOGLE_include_directive : require
// The key of the sort that parts the pool: a moving particle's cell, or a still one's in the table of cells behind; the dead
// come after all cells. Twin: engine/reference/cells.cpp.
#include "include/grid.glsl"
#include "include/invocation.glsl"
#include "shared/particle_state.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Key { uint key[]; };

void main()
{
    uint i = invocation_index();
    if (i < params.pool_count) {
        uint cells = params.grid_size.x * params.grid_size.y * params.grid_size.z;
        uint cell = cell_of(position[i].xyz, params.domain_min, params.support_radius, params.grid_size);
        key[i] = is_gone(attributes[i]) ? 2u * cells : cell + (is_still(attributes[i]) ? cells : 0u);
    }
}
