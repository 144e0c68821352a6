// A tile's walks around its particles and around their images. Include it after the declarations of `params`, `position`
// and `position_texels`.
#ifndef IMAGE_WALK_GLSL
#define IMAGE_WALK_GLSL
#include "include/candidate.glsl"
#include "include/neighbor_walk.glsl"
#include "include/periodic.glsl"
#include "include/walls.glsl"

const int TOGETHER = -1;

// The particles that one invocation owns: first .. last; where there are fewer than TILE, the last one is repeated.
struct Tile {
    uint first;
    uint last;
    uint images;      // that at least one of them has, bit 0 themselves: a bit for each number of an image
    bool is_wide;     // they walk one by one
    uint images_left; // of those who walk
    int walks;        // that one of them, or TOGETHER
    uint next_word;   // of include/neighbor_bits.glsl, for the next chunk of candidates
};

Walk begin_walk(vec3 x[TILE]) { return begin_walk(x, params.domain_min, params.support_radius, params.grid_size); }

// The nearer border along each axis, wall or periodic: a box is at least two support radii wide, so the other is out of reach.
Walls nearest_borders(vec3 x)
{
    return nearest_walls(x, params.domain_min, params.domain_max, params.wall_mask | params.periodic_mask);
}

// Turns a vector into that of the image, or back: -1 along the axes that the image reflects, 1 along the others.
vec3 image_signs(uint image)
{
    return mix(mix(vec3(1.0), vec3(-1.0), image_axes(image)), vec3(1.0), periodic_axes());
}

// What the lid's velocity adds to that of the fluid beyond the walls, times the half spaces' integrals.
vec3 lid_share(Walls walls, vec3 half_spaces) { return walls.normal.y < 0.0 ? half_spaces.y * params.lid_velocity : vec3(0.0); }

// Whether a position has such an image beyond these borders, and where it is.
bool has_image(uint image, Walls borders)
{
    return all(lessThan(mix(vec3(0.0), borders.distance, image_axes(image)), vec3(params.support_radius)));
}

vec3 image_position(vec3 x, uint image, Walls borders)
{
    vec3 reflected = 2.0 * borders.plane - x;
    vec3 shifted = x + borders.normal * (params.domain_max - params.domain_min);
    return mix(x, mix(reflected, shifted, periodic_axes()), image_axes(image));
}

// A tile of the particles begin .. end - 1. `own`: the positions and weights of its particles.
Tile load_tile_of(uint begin, uint end, uint invocation, out vec4 own[TILE])
{
    Tile tile;
    tile.first = begin + invocation * TILE;
    tile.last = min(tile.first + TILE, end) - 1u;
    uvec3 near_walls = uvec3(0u); // axes along which at least one has a border within its support
    vec3 x[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        own[k] = load_candidate(position, min(tile.first + k, tile.last));
        x[k] = own[k].xyz;
        near_walls |= uvec3(lessThan(nearest_borders(x[k]).distance, vec3(params.support_radius)));
    }
    tile.images = 1u;
    tile.images |= near_walls.x * tile.images << 1u;
    tile.images |= near_walls.y * tile.images << 2u;
    tile.images |= near_walls.z * tile.images << 4u;
    tile.is_wide = TILE > 1u && is_wide(begin_walk(x));
    return tile;
}

// One of the moving particles.
Tile load_tile(uint invocation, out vec4 own[TILE]) { return load_tile_of(0u, params.moving_count, invocation, own); }

uint first_image(inout Tile tile)
{
    tile.images_left = tile.images;
    tile.walks = tile.is_wide ? 0 : TOGETHER;
    tile.next_word = tile.first / TILE;
    return 0u;
}

uint next_image(inout Tile tile)
{
    tile.images_left &= tile.images_left - 1u;
    bool next_particle = tile.is_wide && tile.images_left == 0u && tile.first + uint(tile.walks) < tile.last;
    tile.walks += next_particle ? 1 : 0;
    tile.images_left = next_particle ? tile.images : tile.images_left;
    return uint(findLSB(tile.images_left));
}

// The image of each particle that walks; NOWHERE for the others and for those who have none. Image 0 is the particle itself.
void image_positions(Tile tile, vec4 own[TILE], uint image, out vec3 x[TILE])
{
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        Walls borders = nearest_borders(own[k].xyz);
        bool walks = tile.walks == TOGETHER || tile.walks == int(k);
        x[k] = walks && has_image(image, borders) ? image_position(own[k].xyz, image, borders) : NOWHERE;
    }
}

// for every image that the tile has, in ascending order
#define FOR_EACH_IMAGE(image, tile)                                                                                   \
    for (uint image = first_image(tile); tile.images_left != 0u; image = next_image(tile))

#endif
