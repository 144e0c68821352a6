// The walls' contact, where particles are moved and not pushed: lone ones never reach rest density at a plane, so nothing but
// the contact keeps them inside. Include it after the declaration of `params`. C++ twin: engine/reference/integrate.
#ifndef CONTACT_GLSL
#define CONTACT_GLSL
#include "shared/sph_params.h"

// What may move a particle along an axis in `seconds` that lies now at a distance inside the wall, and must not come too near.
float slowest(float distance, float seconds) { return min((params.contact_distance - distance) / seconds, 0.0); }

// A velocity without what would bring a particle at x nearer to a wall than contact_distance in `seconds`; a move, in 1.
vec3 with_contact(vec3 x, vec3 v, float seconds)
{
    [[unroll]] for (int axis = 0; axis < 3; ++axis) {
        if ((params.wall_mask >> (2 * axis) & 1u) != 0u) {
            v[axis] = max(v[axis], slowest(x[axis] - params.domain_min[axis], seconds));
        }
        if ((params.wall_mask >> (2 * axis + 1) & 1u) != 0u) {
            v[axis] = min(v[axis], -slowest(params.domain_max[axis] - x[axis], seconds));
        }
    }
    return v;
}

#endif
