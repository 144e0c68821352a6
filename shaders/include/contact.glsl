// The walls' contact, where particles are moved and not pushed: lone ones never reach rest density at a plane, so nothing but
// the contact keeps them inside. Include it after the declaration of `params`. C++ twin: engine/reference/integrate.
#ifndef CONTACT_GLSL
#define CONTACT_GLSL
#include "shared/sph_params.h"

bvec3 has_walls(uint first) { return notEqual(params.wall_mask & (uvec3(1u, 4u, 16u) << first), uvec3(0u)); }

// A velocity without what would bring a particle at x nearer to a wall than contact_distance in `seconds`; a move, in 1. All axes at
// once: software devices take a millisecond a dispatch for a vector that a loop indexes.
vec3 with_contact(vec3 x, vec3 v, float seconds)
{
    vec3 from_low = min((params.contact_distance - (x - params.domain_min)) / seconds, 0.0);
    vec3 from_high = min((params.contact_distance - (params.domain_max - x)) / seconds, 0.0);
    v = mix(v, max(v, from_low), has_walls(0u));
    return mix(v, min(v, -from_high), has_walls(1u));
}

#endif
