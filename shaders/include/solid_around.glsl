// How the still particles around a place fill it, and hold up what is there. Include it after the declarations of `params`,
// `wind`, `position` and `position_texels`, with CELL_START_BINDING defined, in a pass whose TILE is 1.
#ifndef SOLID_AROUND_GLSL
#define SOLID_AROUND_GLSL
#include "include/image_walk.glsl"

// A walk is that of a tile: here of a particle that may be anywhere.
Tile tile_at(vec3 x)
{
    uvec3 near = uvec3(lessThan(nearest_borders(x).distance, vec3(params.support_radius)));
    uint images = 1u;
    images |= near.x * images << 1u;
    images |= near.y * images << 2u;
    images |= near.z * images << 4u;
    return Tile(0u, 0u, images, false, 0u, TOGETHER, 0u);
}

// x: sum of V W over the still particles and their images. y: the same, of each the part that pushes up: times the cosine of
// the angle between up and the way from it to here, where that is positive.
vec2 solid_around(vec3 here)
{
    KernelSize size = kernel_size(params.support_radius);
    vec4 own[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        own[k] = vec4(k == 0u ? here : NOWHERE, 0.0);
    }
    vec2 sum = vec2(0.0);
    Tile tile = tile_at(here);
    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        vec3 up = image_signs(image) * wind.up;
        Walk walk = begin_walk(x, params.domain_min, params.support_radius, params.grid_size);
        walk.table = int(params.grid_size.x * params.grid_size.y * params.grid_size.z); // of the still ones alone
        FOR_EACH_CANDIDATE(range, walk) {
            vec4 neighbor = load_candidate(position, range.x);
            vec3 offset = x[0] - neighbor.xyz;
            float r2 = dot(offset, offset);
            float filling = neighbor.w * density_shape(r2, size);
            sum += filling * vec2(1.0, max(dot(offset, up), 0.0) * inversesqrt(max(r2, size.coincident2)));
        }
    }
    return params.lattice_volume * params.density_scale * sum;
}

#endif
