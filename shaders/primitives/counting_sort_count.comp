// Counting sort, pass 1: how many elements each key has.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/invocation.glsl"
#include "shared/counting_sort.h"

layout(std430, binding = 0) readonly buffer Keys { uint keys[]; };
layout(std430, binding = 1) buffer Counts { uint counts[]; };

layout(push_constant, scalar) uniform Push { CountingSortParams params; };

void main()
{
    const uint i = invocation_index();
    if (i < params.count && keys[i] < params.key_count) {
        atomicAdd(counts[keys[i]], 1u);
    }
}
