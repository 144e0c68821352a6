// The sheet over columns of sand (shared/sand_surface.h). Its corners are those of the texels of the map from above: one more
// than these along each side. Include it after the declaration of `view`, the map's VisibilityParams.
#ifndef SAND_SHEET_GLSL
#define SAND_SHEET_GLSL

// World space, m: a point of the map, in texels, so many m above the floor, which is as deep as the map.
vec3 place_over_map(vec2 at, float height)
{
    vec2 along = at * view.texel;
    float fall = float(DEPTH_STEPS) / view.depth_scale - height;
    return view.origin + along.x * view.right + along.y * view.up + fall * view.direction;
}

// Back again, xy in texels, z in m above the floor.
vec3 place_on_map(vec3 x)
{
    vec3 offset = x - view.origin;
    float depth = dot(offset, view.direction);
    return vec3(dot(offset, view.right) / view.texel, dot(offset, view.up) / view.texel,
                float(DEPTH_STEPS) / view.depth_scale - depth);
}

uint corner_index(uvec2 corner) { return corner.y * (view.width + 1u) + corner.x; }

// The corners of a quad are 0, 1 along the map's rows, 2 and 3 above these.
uvec2 quad_corner(uint quad, uint k) { return uvec2(quad % view.width, quad / view.width) + uvec2(k & 1u, k >> 1u); }

// Of what the corners have, at a place in the texel between them.
vec4 bilinear(vec4 a, vec4 b, vec4 c, vec4 d, vec2 f) { return mix(mix(a, b, f.x), mix(c, d, f.x), f.y); }

#endif
