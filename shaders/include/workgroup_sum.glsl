// Sum over the invocations of a workgroup, always in the same order: of vec2, or of what SUM_TYPE was defined as before.
#ifndef WORKGROUP_SUM_GLSL
#define WORKGROUP_SUM_GLSL

#include "include/invocation.glsl"

#ifndef SUM_TYPE
#define SUM_TYPE vec2
#endif

shared SUM_TYPE workgroup_terms[WORKGROUP_SIZE];

// To be called by all invocations; only the first one gets the sum.
SUM_TYPE workgroup_sum(SUM_TYPE term)
{
    workgroup_terms[gl_LocalInvocationIndex] = term;
    barrier();
    SUM_TYPE sum = SUM_TYPE(0.0);
    if (gl_LocalInvocationIndex == 0u) {
        for (uint i = 0u; i < WORKGROUP_SIZE; ++i) {
            sum += workgroup_terms[i];
        }
    }
    barrier(); // before the next call overwrites the terms
    return sum;
}

#endif
