// Exclusive prefix sum over the invocations of a workgroup.
#ifndef WORKGROUP_SCAN_GLSL
#define WORKGROUP_SCAN_GLSL

#include "include/invocation.glsl"

shared uint workgroup_values[WORKGROUP_SIZE];

// The sum of `value` over the invocations before this one; `total` is the sum over all. To be called by all invocations.
// Every invocation adds up all the values: reads of one word that all invocations share are broadcast, so that on GPUs this
// takes about as long as the barriers of a logarithmic scan, and on software devices, where barriers are dear, less.
uint workgroup_exclusive_sum(uint value, out uint total)
{
    workgroup_values[gl_LocalInvocationIndex] = value;
    barrier();
    uint before = 0u;
    total = 0u;
    for (uint i = 0u; i < WORKGROUP_SIZE; ++i) {
        before += i < gl_LocalInvocationIndex ? workgroup_values[i] : 0u;
        total += workgroup_values[i];
    }
    barrier(); // before the next call overwrites the values
    return before;
}

#endif
