// Periodic axes: what leaves through one border comes in through the other. Include it after the declaration of `params`. C++
// twin: engine/reference/walls.h.
#ifndef PERIODIC_GLSL
#define PERIODIC_GLSL

bvec3 periodic_axes() { return notEqual(uvec3(params.periodic_mask) & uvec3(1u, 4u, 16u), uvec3(0u)); }

// A position, back in the domain along periodic axes. One that is not a number stays so.
vec3 wrapped(vec3 x)
{
    vec3 size = mix(vec3(0.0), params.domain_max - params.domain_min, periodic_axes());
    return x + mix(vec3(0.0), size, lessThan(x, params.domain_min)) - mix(vec3(0.0), size, greaterThanEqual(x, params.domain_max));
}

// Along a unit vector that is an axis or its opposite.
bool is_periodic_along(vec3 axis) { return dot(mix(vec3(0.0), vec3(1.0), periodic_axes()), abs(axis)) > 0.5; }

// A texel of a map of the domain that is beyond the map's border: that at the border, or, where space is periodic, at the other
// one.
int inside(int i, int count, bool is_periodic) { return is_periodic ? (i + count) % count : clamp(i, 0, count - 1); }

#endif
