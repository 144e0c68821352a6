// The ground that sand lies on, seen from above: of each texel of a depth map (shared/visibility.h), a spacing wide, the plane
// that fits the tops around it best. Include it after the declarations of `params`, `view`, the map's VisibilityParams, `wind`, and
// `ground`.
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

Ground ground_at(vec3 x)
{
    ivec2 texel = texel_at(x);
    vec4 plane = ground[texel.y * int(view.width) + texel.x];
    return Ground(plane.x, plane.y * view.right + plane.z * view.up, plane.w);
}

// The steepest way down from x, of eight: the gradient of the ground along it, zero where all lead up. A plane would not see that
// a thin tower is steep: the tops themselves are compared.
vec3 steepest_fall(vec3 x)
{
    ivec2 here = texel_at(x);
    float top = ground[here.y * int(view.width) + here.x].w; // loose grains lie on it: they themselves are no slope
    bool along = is_periodic_along(view.right);
    bool across = is_periodic_along(view.up);
    vec3 steepest = vec3(0.0);
    float its_slope = 0.0;
    for (int k = 0; k < 9; ++k) {
        ivec2 way = FALL_REACH * ivec2(k % 3 - 1, k / 3 - 1);
        ivec2 there = ivec2(inside(here.x + way.x, int(view.width), along), inside(here.y + way.y, int(view.height), across));
        float reach = max(length(vec2(way)), 1.0);
        float slope = (top - ground[there.y * int(view.width) + there.x].w) / (reach * view.texel);
        if (k != 4 && slope > its_slope + EQUAL_FALL) {
            its_slope = slope;
            steepest = -slope / reach * (float(way.x) * view.right + float(way.y) * view.up);
        }
    }
    return steepest;
}

#endif
