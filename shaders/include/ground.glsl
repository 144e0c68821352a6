// The ground that sand lies on, seen from above: of each texel of a depth map (shared/visibility.h), a spacing wide, the plane
// that fits the tops around it best. Include it after the declarations of `view`, the map's VisibilityParams, `wind`, and `ground`.
#ifndef GROUND_GLSL
#define GROUND_GLSL

struct Ground {
    float height; // m above the floor: of the plane, through the centers of the uppermost particles
    vec3 slope;   // its gradient, at right angles to up
    float top;    // m above the floor: of the uppermost particle
};

// m above the floor.
float height_of(vec3 x) { return dot(x, wind.up) - wind.floor_height; }

Ground ground_at(vec3 x)
{
    vec3 offset = (x - view.origin) / view.texel;
    ivec2 texel = clamp(ivec2(floor(vec2(dot(offset, view.right), dot(offset, view.up)))), ivec2(0),
                        ivec2(view.width, view.height) - 1);
    vec4 plane = ground[texel.y * int(view.width) + texel.x];
    return Ground(plane.x, plane.y * view.right + plane.z * view.up, plane.w);
}

// Whether sand at x lies steeper than so, and has somewhere to slide to.
bool is_steep(vec3 x, Ground below, float tangent)
{
    float slope = length(below.slope);
    float way = DROP_REACH * view.texel;
    float drop = height_of(x) - ground_at(x - way / max(slope, 1e-30) * below.slope).height;
    return slope > tangent && drop > LEAST_DROP * tangent * way;
}

#endif
