#version 460
#extension GL_GOOGLE_include_directive : require
// For the statistics of a frame: how many other particles lie within the support radius of each, and how many of them are
// so close that their pair has no direction. Twin: engine/reference/cells.cpp.
#define CELL_START_BINDING 1
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Neighbors { uint neighbors[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Coincident { uint coincident[]; };

void main()
{
    uint first = invocation_index() * TILE;
    if (first >= params.particle_count) {
        return;
    }
    uint last = min(first + TILE, params.particle_count) - 1u;

    vec3 x[TILE];
    uint within[TILE];
    uint touching[TILE];
    Walk walk = empty_walk(params.grid_size);
    for (uint k = 0u; k < TILE; ++k) {
        x[k] = position[min(first + k, last)].xyz;
        include_position(walk, x[k], params.domain_min, params.support_radius);
        within[k] = 0u;
        touching[k] = 0u;
    }

    float support2 = params.support_radius * params.support_radius;
    float coincident2 = COINCIDENT_RATIO * COINCIDENT_RATIO * support2;
    FOR_EACH_CANDIDATE(range, walk) {
        vec3 xj = position[range.x].xyz;
        for (uint k = 0u; k < TILE; ++k) {
            vec3 offset = x[k] - xj;
            float r2 = dot(offset, offset);
            within[k] += r2 < support2 ? 1u : 0u;
            touching[k] += r2 <= coincident2 ? 1u : 0u;
        }
    }

    for (uint k = 0u; k < TILE && first + k <= last; ++k) {
        neighbors[first + k] = within[k] - 1u; // without itself
        coincident[first + k] = touching[k] - 1u;
    }
}
