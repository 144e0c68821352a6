// A tile's walks around its particles and around their images. Include it after the declarations of `params`, `position`
// and `position_texels`.
#ifndef IMAGE_WALK_GLSL
#define IMAGE_WALK_GLSL
#include "include/candidate.glsl"
#include "include/neighbor_walk.glsl"
#include "include/walls.glsl"

// The particles that one invocation owns: first .. last; where there are fewer than TILE, the last one is repeated.
struct Tile {
    uint first;
    uint last;
    uint images; // that at least one of them has, bit 0 themselves: a bit for each number of an image
};

// `own`: the positions and weights of its particles.
Tile load_tile(uint invocation, out vec4 own[TILE])
{
    Tile tile;
    tile.first = invocation * TILE;
    tile.last = min(tile.first + TILE, params.particle_count) - 1u;
    uvec3 near_walls = uvec3(0u); // axes along which at least one has a wall within its support
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        own[k] = load_candidate(position, min(tile.first + k, tile.last));
        Walls walls = nearest_walls(own[k].xyz, params.domain_min, params.domain_max, params.wall_mask);
        near_walls |= uvec3(lessThan(walls.distance, vec3(params.support_radius)));
    }
    tile.images = 1u;
    tile.images |= near_walls.x * tile.images << 1u;
    tile.images |= near_walls.y * tile.images << 2u;
    tile.images |= near_walls.z * tile.images << 4u;
    return tile;
}

// The image of each particle, NOWHERE if it has none. Image 0 is the particle itself.
void image_positions(vec4 own[TILE], uint image, out vec3 x[TILE])
{
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        Walls walls = nearest_walls(own[k].xyz, params.domain_min, params.domain_max, params.wall_mask);
        x[k] = image_position(own[k].xyz, image, walls, params.support_radius);
    }
}

Walk begin_walk(vec3 x[TILE], out vec3 present[TILE])
{
    return begin_walk(x, present, params.domain_min, params.support_radius, params.grid_size);
}

// for every image that the tile has, in ascending order
#define FOR_EACH_IMAGE(image, tile)                                                                                       for (uint images_left = tile.images, image = 0u; images_left != 0u;                                                        images_left &= images_left - 1u, image = uint(findLSB(images_left)))

#endif
