// Prefix scan, pass 1 of 3: the sum of every block.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/prefix_scan.glsl"

layout(std430, binding = 0) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 1) writeonly buffer BlockSums { uint block_sums[]; };

void main()
{
    const uint block = workgroup_index();
    const uint begin = min(block * BLOCK, count);
    const uint end = min(begin + BLOCK, count);

    // The order of a sum is free: neighboring invocations read neighboring words.
    uint sum = 0u;
    for (uint i = begin + gl_LocalInvocationIndex; i < end; i += WORKGROUP_SIZE) {
        sum += counts[i];
    }
    uint block_sum;
    workgroup_exclusive_sum(sum, block_sum);
    if (gl_LocalInvocationIndex == 0u && begin < end) {
        block_sums[block] = block_sum;
    }
}
