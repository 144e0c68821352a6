// What the passes of shared/capillarity.h have in common.
#ifndef CAPILLARITY_GLSL
#define CAPILLARITY_GLSL
#include "shared/capillarity.h"

// Mirrors show no normals: at a contact angle of 90 degrees they would be right, at no other. Periodic images are as good as
// the particles themselves. signs: image_signs().
float shows_normals(vec3 signs) { return all(greaterThan(signs, vec3(0.0))) ? 1.0 : 0.0; }

// 0 inside, 1 at a surface; `normal` is smoothed.
float surface_share(vec3 normal, float support_radius)
{
    float steepness = length(normal) * support_radius;
    return clamp((steepness - INSIDE_STEEPNESS) / (SURFACE_STEEPNESS - INSIDE_STEEPNESS), 0.0, 1.0);
}

vec3 outward(vec3 normal) { return -normal / max(length(normal), 1e-30); }

#endif
