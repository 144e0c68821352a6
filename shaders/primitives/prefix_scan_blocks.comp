// Prefix scan, pass 2 of 3: one workgroup scans the sums of the blocks in place, and stores the total.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/prefix_scan.glsl"

layout(std430, binding = 0) buffer BlockSums { uint block_sums[]; };
layout(std430, binding = 1) writeonly buffer Starts { uint starts[]; };

void main()
{
    const uint block_count = (count + BLOCK - 1u) / BLOCK;
    uint carry = 0u;
    for (uint base = 0u; base < block_count; base += BLOCK) {
        const uint begin = min(base + gl_LocalInvocationIndex * ELEMENTS, block_count);
        const uint end = min(begin + ELEMENTS, block_count);
        uint sum = 0u;
        for (uint i = begin; i < end; ++i) {
            sum += block_sums[i];
        }
        uint total;
        uint running = carry + workgroup_exclusive_sum(sum, total);
        for (uint i = begin; i < end; ++i) {
            const uint block_sum = block_sums[i];
            block_sums[i] = running;
            running += block_sum;
        }
        carry += total;
    }
    if (gl_LocalInvocationIndex == 0u) {
        starts[count] = carry;
    }
}
