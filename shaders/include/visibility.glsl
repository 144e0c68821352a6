// What is seen along a direction (shared/visibility.h). Include it after the declarations of `view`, its VisibilityParams, and of
// `map`, its depths. C++ twin: engine/reference/visibility.cpp.
#ifndef VISIBILITY_GLSL
#define VISIBILITY_GLSL
#include "shared/visibility.h"

// In texels along the map's rows and across them, and the depth in m.
vec3 map_place(vec3 x)
{
    vec3 offset = x - view.origin;
    return vec3(dot(offset, view.right) / view.texel, dot(offset, view.up) / view.texel, dot(offset, view.direction));
}

// In steps. Exactly the same in all shaders: who is seen on the map has its depth.
uint depth_of(vec3 x)
{
    precise float depth = dot(x - view.origin, view.direction);
    precise float steps = clamp(depth * view.depth_scale, 0.0, float(DEPTH_STEPS - 1u));
    return uint(steps);
}

// How much of the surface at x, with the unit normal n, is seen, 0 to 1. What lies beside the map is seen.
float seen_share(vec3 x, vec3 n)
{
    vec3 place = map_place(x + RECEIVER_DISTANCE * view.spacing * n);
    // How much deeper the plane through this point lies, a texel on.
    float incidence = max(-dot(n, view.direction), LEAST_INCIDENCE);
    vec2 slope = view.texel / incidence * vec2(dot(n, view.right), dot(n, view.up));
    vec2 first = floor(place.xy - 0.5);
    float seen = 0.0;
    for (uint corner = 0u; corner < 4u; ++corner) {
        vec2 texel = first + vec2(corner & 1u, corner >> 1u);
        vec2 offset = texel + 0.5 - place.xy;
        vec2 weight = 1.0 - abs(offset);
        bool in_map = all(greaterThanEqual(texel, vec2(0.0))) && all(lessThan(texel, vec2(view.width, view.height)));
        float depth = in_map ? float(map[uint(texel.y) * view.width + uint(texel.x)]) / view.depth_scale : 0.0;
        float needed = place.z + dot(slope, offset);
        seen += !in_map || depth >= needed ? weight.x * weight.y : 0.0;
    }
    return seen;
}

#endif
