// Sum over all invocations of a dispatch, always in the same order: each workgroup leaves its own sum, and the one that is done
// last adds these up. Before including: #define WORKGROUP_SUMS, a coherent array of SUM_TYPE with an entry for each workgroup, and
// ARRIVED, a coherent uint that is 0 between dispatches; both of storage buffers.
#ifndef DISPATCH_SUM_GLSL
#define DISPATCH_SUM_GLSL

#include "include/workgroup_sum.glsl"

shared uint workgroups_before; // that were done when this one was

// To be called by all invocations. True in the one that gets the sum; for the others it is lost.
bool dispatch_sum(inout SUM_TYPE term)
{
    term = workgroup_sum(term);
    if (gl_LocalInvocationIndex == 0u) {
        WORKGROUP_SUMS[workgroup_index()] = term;
        memoryBarrierBuffer(); // before the count that tells the last workgroup that it is there
        workgroups_before = atomicAdd(ARRIVED, 1u);
    }
    barrier();
    uint workgroups = gl_NumWorkGroups.x * gl_NumWorkGroups.y;
    if (workgroups_before + 1u < workgroups) {
        return false;
    }
    memoryBarrierBuffer();
    term = SUM_TYPE(0.0);
    for (uint i = gl_LocalInvocationIndex; i < workgroups; i += WORKGROUP_SIZE) {
        term += WORKGROUP_SUMS[i];
    }
    term = workgroup_sum(term);
    if (gl_LocalInvocationIndex == 0u) {
        ARRIVED = 0u;
    }
    return gl_LocalInvocationIndex == 0u;
}

#endif
