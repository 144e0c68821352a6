#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// For the statistics of a frame: how many other particles lie within the support radius of each, and how many of them are
// so close that their pair has no direction. Twin: engine/reference/cells.cpp.
#define CELL_START_BINDING 1
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "shared/neighbor_count.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer Counts { NeighborCount counts[]; };

#include "include/image_walk.glsl"

// Of the numbers of images, a bit each, those that are only shifted along periodic axes.
uint shifted_images()
{
    uvec3 periodic = uvec3(periodic_axes());
    uint images = 1u; // themselves
    images |= periodic.x * images << 1u;
    images |= periodic.y * images << 2u;
    images |= periodic.z * images << 4u;
    return images;
}

void main()
{
    if (invocation_index() * TILE >= params.moving_count) {
        return;
    }
    vec4 own[TILE];
    Tile tile = load_tile(invocation_index(), own);
    tile.images &= shifted_images(); // no reflections
    NeighborCount found[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        found[k] = NeighborCount(0u, 0u, 0u);
    }

    float support2 = params.support_radius * params.support_radius;
    float coincident2 = COINCIDENT_RATIO * COINCIDENT_RATIO * support2;
    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        Walk walk = begin_walk(x);
        FOR_EACH_CANDIDATE(range, walk) {
            vec3 xj = load_candidate(position, range.x).xyz;
            uint id_j = id[range.x];
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj;
                float r2 = dot(offset, offset);
                bool other = range.x != tile.first + k;
                found[k].neighbors += other && r2 < support2 ? 1u : 0u;
                found[k].id_sum += other && r2 < support2 ? id_j : 0u;
                found[k].coincident += other && r2 <= coincident2 ? 1u : 0u;
            }
        }
    }

    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        if (tile.first + k > tile.last) {
            break;
        }
        counts[tile.first + k] = found[k];
    }
}
