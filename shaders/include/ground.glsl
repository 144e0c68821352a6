// The ground that sand lies on, seen from above: of each texel of a depth map (shared/visibility.h), a spacing wide, the column
// that stands there and the plane that fits the tops around it best. Include it after the declarations of `params`, `view`, the
// map's VisibilityParams, `wind`, and `ground`, and of `top_id` where column_top() is called.
#ifndef GROUND_GLSL
#define GROUND_GLSL
#include "include/periodic.glsl"

struct Ground {
    float height; // m above the floor: of the plane, through the centers of the uppermost particles
    vec3 slope;   // its gradient, at right angles to up
    float top;    // m above the floor: of the uppermost particle
};

// m above the floor.
float height_of(vec3 x) { return dot(x, wind.up) - wind.floor_height; }

ivec2 texel_at(vec3 x)
{
    vec3 offset = (x - view.origin) / view.texel;
    return clamp(ivec2(floor(vec2(dot(offset, view.right), dot(offset, view.up)))), ivec2(0), ivec2(view.width, view.height) - 1);
}

uint index_of(ivec2 texel) { return uint(texel.y) * view.width + uint(texel.x); }

Ground ground_at(ivec2 texel)
{
    vec4 plane = ground[index_of(texel)];
    return Ground(plane.x, plane.y * view.right + plane.z * view.up, plane.w);
}

// One of the eight around a texel, k % 3 - 1, k / 3 - 1 away: itself where that is beyond a border.
ivec2 neighbor_of(ivec2 texel, uint k)
{
    ivec2 there = texel + ivec2(k % 3u, k / 3u) - 1;
    return ivec2(inside(there.x, int(view.width), is_periodic_along(view.right)),
                 inside(there.y, int(view.height), is_periodic_along(view.up)));
}

struct WayDown {
    uint way;   // WAY_NONE, or k of neighbor_of
    float drop; // in spacings
};

// The steepest way down from so high over a texel where that is too steep. Two measures of steep: the plane through the columns
// around, and the step to a single one, in spacings.
WayDown way_down(ivec2 texel, float height, uint its_id, float steepest_ground, float steepest_step)
{
    vec3 plane = ground_at(texel).slope;
    bool on_steep_ground = length(plane) > steepest_ground;
    WayDown found = WayDown(WAY_NONE, 0.0);
    float steepest = 0.0; // drop over distance
    uint first = first_way(its_id);
    for (uint turn = 0u; turn < 8u; ++turn) {
        uint k = (first + turn) % 8u;
        k += k >= WAY_NONE ? 1u : 0u;
        vec2 along = vec2(k % 3u, k / 3u) - 1.0;
        float drop = (height - ground_at(neighbor_of(texel, k)).top) / params.spacing;
        float slope = drop / length(along);
        bool downhill = dot(plane, along.x * view.right + along.y * view.up) < 0.0;
        bool slides = slope > steepest_step || (on_steep_ground && downhill && drop > LEAST_STEP);
        if (slides && slope > steepest + EQUAL_STEP) {
            steepest = slope;
            found = WayDown(k, drop);
        }
    }
    return found;
}

// Where a particle in the middle of a column is, so many m above the floor: in the domain.
vec3 place_in_column(ivec2 texel, float height)
{
    vec2 middle = (vec2(texel) + 0.5) * view.texel;
    vec3 x = view.origin + middle.x * view.right + middle.y * view.up;
    x += (height - height_of(x)) * wind.up;
    vec3 half_way = 0.5 * (params.domain_min + params.domain_max); // of an axis that is shorter than a spacing
    return clamp(x, min(params.domain_min + 0.5 * params.spacing, half_way), max(params.domain_max - 0.5 * params.spacing, half_way));
}

#endif
