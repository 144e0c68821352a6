// A tile's walk around the images of its particles. Include it after the declarations of `params` and `position`.
#ifndef IMAGE_WALK_GLSL
#define IMAGE_WALK_GLSL
#include "include/neighbor_walk.glsl"
#include "include/walls.glsl"

// The image of each particle first .. last (the last one repeated if the tile is not full), and the walk around those that
// exist. Image 0 is the particle itself.
Walk begin_image_walk(uint first, uint last, uint image, out vec3 x[TILE])
{
    Walk walk = empty_walk(params.grid_size);
    for (uint k = 0u; k < TILE; ++k) {
        vec3 own = position[min(first + k, last)].xyz;
        Walls walls = nearest_walls(own, params.domain_min, params.domain_max, params.wall_mask);
        x[k] = image_position(own, image, walls, params.support_radius);
        if (x[k] != NOWHERE) {
            include_position(walk, x[k], params.domain_min, params.support_radius);
        }
    }
    return walk;
}

#endif
