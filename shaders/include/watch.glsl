// The watch over what may go wrong with a particle that has moved. Include it after the declarations of `params`, `id`,
// `attributes` and `status`.
#ifndef WATCH_GLSL
#define WATCH_GLSL
#include "shared/particle_state.h"

bool is_outside(vec3 x) { return any(lessThan(x, params.domain_min)) || any(greaterThan(x, params.domain_max)); }

uint find_fault(vec3 x, vec3 v)
{
    if (any(isnan(x)) || any(isinf(x)) || any(isnan(v)) || any(isinf(v))) {
        return FAULT_NOT_FINITE;
    }
    if (dot(v, v) > params.speed_limit * params.speed_limit) {
        return FAULT_TOO_FAST; // and that is why it may have left, too
    }
    return is_outside(x) ? FAULT_ESCAPED : FAULT_NONE;
}

// Marks a particle that has left the domain, and notes the first step that has a faulty one and the smallest id of these.
void watch(uint i, vec3 x, vec3 v, uint step_index)
{
    if (is_outside(x)) {
        attributes[i] |= FLAG_LEFT_DOMAIN;
    }
    uint fault = find_fault(x, v);
    if (fault == FAULT_NONE) {
        return;
    }
    // Steps run one after the other: an earlier faulty step has already left a smaller number.
    if (atomicMin(status.first_faulty_step, step_index) >= step_index) {
        atomicMin(status.offender, pack_offender(id[i], fault));
    }
}

#endif
