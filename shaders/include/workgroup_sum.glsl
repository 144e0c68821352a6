// Sum over the invocations of a workgroup, always in the same order.
#ifndef WORKGROUP_SUM_GLSL
#define WORKGROUP_SUM_GLSL

#include "include/invocation.glsl"

shared vec2 workgroup_terms[WORKGROUP_SIZE];

// To be called by all invocations; only the first one gets the sum.
vec2 workgroup_sum(vec2 term)
{
    workgroup_terms[gl_LocalInvocationIndex] = term;
    barrier();
    vec2 sum = vec2(0.0);
    if (gl_LocalInvocationIndex == 0u) {
        for (uint i = 0u; i < WORKGROUP_SIZE; ++i) {
            sum += workgroup_terms[i];
        }
    }
    barrier(); // before the next call overwrites the terms
    return sum;
}

#endif
