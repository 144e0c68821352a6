#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// For the statistics of a frame: how many other particles lie within the support radius of each, and how many of them are
// so close that their pair has no direction. Twin: engine/reference/cells.cpp.
#define CELL_START_BINDING 1
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "shared/neighbor_count.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Counts { NeighborCount counts[]; };

void main()
{
    uint first = invocation_index() * TILE;
    if (first >= params.particle_count) {
        return;
    }
    uint last = min(first + TILE, params.particle_count) - 1u;

    vec3 x[TILE];
    NeighborCount found[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        x[k] = position[min(first + k, last)].xyz;
        found[k] = NeighborCount(0u, 0u, 0u);
    }

    float support2 = params.support_radius * params.support_radius;
    float coincident2 = COINCIDENT_RATIO * COINCIDENT_RATIO * support2;
    vec3 present[TILE];
    Walk walk = begin_walk(x, present, params.domain_min, params.support_radius, params.grid_size);
    FOR_EACH_CANDIDATE(range, walk, x, present) {
        vec3 xj = position[range.x].xyz;
        uint id_j = id[range.x];
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            vec3 offset = present[k] - xj;
            float r2 = dot(offset, offset);
            bool other = range.x != first + k;
            found[k].neighbors += other && r2 < support2 ? 1u : 0u;
            found[k].id_sum += other && r2 < support2 ? id_j : 0u;
            found[k].coincident += other && r2 <= coincident2 ? 1u : 0u;
        }
    }

    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        if (first + k > last) {
            break;
        }
        counts[first + k] = found[k];
    }
}
