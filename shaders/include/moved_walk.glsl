// Neighbors of particles that have moved since the grid was made: the pairs that were neighbors then, at the distances that
// they have now. So they see each other from both sides, whatever the tile. A pair that has come within the support radius since
// is left out; after moves of at most m such pairs are farther apart than the support radius less 2 m. Include it after the
// declarations of `params`, `position`, `moved` (positions when the grid was made, and now) and their texels.
#ifndef MOVED_WALK_GLSL
#define MOVED_WALK_GLSL
#include "include/image_walk.glsl"
#include "include/neighbor_bits.glsl"

// The present positions of a tile's particles, and their weights.
void load_moved(Tile tile, out vec4 now[TILE])
{
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        now[k] = load_candidate(moved, min(tile.first + k, tile.last));
    }
}

// The images, beyond the borders that were near when the grid was made, of where the particles are now.
void moved_image_positions(vec4 own[TILE], vec4 now[TILE], uint image, out vec3 x[TILE])
{
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        x[k] = image_position(now[k].xyz, image, nearest_borders(own[k].xyz));
    }
}

// Whether they were neighbors when the grid was made.
bool were_neighbors(vec3 a, vec3 b)
{
    vec3 offset = a - b;
    return dot(offset, offset) < params.support_radius * params.support_radius;
}

#endif
