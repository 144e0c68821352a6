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

#endif
