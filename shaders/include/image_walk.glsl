// A tile's walks around its particles and around their images. Include it after the declarations of `params` and `position`.
#ifndef IMAGE_WALK_GLSL
#define IMAGE_WALK_GLSL
#include "include/neighbor_walk.glsl"
#include "include/walls.glsl"

// The particles that one invocation owns: first .. last; where there are fewer than TILE, the last one is repeated.
struct Tile {
    uint first;
    uint last;
    uint near_walls; // axes along which at least one of them has a wall within its support: bits as in an image's number
};

// `own`: the particles' positions.
Tile load_tile(uint invocation, out vec3 own[TILE])
{
    Tile tile;
    tile.first = invocation * TILE;
    tile.last = min(tile.first + TILE, params.particle_count) - 1u;
    tile.near_walls = 0u;
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        own[k] = position[min(tile.first + k, tile.last)].xyz;
        Walls walls = nearest_walls(own[k], params.domain_min, params.domain_max, params.wall_mask);
        bvec3 near = lessThan(walls.distance, vec3(params.support_radius));
        tile.near_walls |= (near.x ? 1u : 0u) | (near.y ? 2u : 0u) | (near.z ? 4u : 0u);
    }
    return tile;
}

bool has_image(Tile tile, uint image) { return (image & ~tile.near_walls) == 0u; }

// The image of each particle, NOWHERE if it has none, and the walk around them. Image 0 is the particle itself.
Walk begin_image_walk(vec3 own[TILE], uint image, out vec3 x[TILE])
{
    Walk walk = empty_walk(params.grid_size);
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        Walls walls = nearest_walls(own[k], params.domain_min, params.domain_max, params.wall_mask);
        x[k] = image_position(own[k], image, walls, params.support_radius);
        if (x[k] != NOWHERE) {
            include_position(walk, x[k], params.domain_min, params.support_radius);
        }
    }
    return walk;
}

#endif
