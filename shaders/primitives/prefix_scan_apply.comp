// Prefix scan, pass 3 of 3: scans every block, beginning with the sum of the blocks before it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/prefix_scan.glsl"

layout(std430, binding = 0) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 1) readonly buffer BlockStarts { uint block_starts[]; };
layout(std430, binding = 2) writeonly buffer Starts { uint starts[]; };

void main()
{
    const uint block = workgroup_index();
    const uint begin = min(block * BLOCK + gl_LocalInvocationIndex * ELEMENTS, count);
    const uint end = min(begin + ELEMENTS, count);
    uint sum = 0u;
    for (uint i = begin; i < end; ++i) {
        sum += counts[i];
    }
    uint total;
    uint running = workgroup_exclusive_sum(sum, total);
    if (begin < end) {
        running += block_starts[block];
    }
    for (uint i = begin; i < end; ++i) {
        starts[i] = running;
        running += counts[i];
    }
}
