// Counting sort, pass 3: every element takes a slot of its key, in whatever order the atomics happen. Counts the counters
// back down to zero.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/invocation.glsl"
#include "shared/counting_sort.h"

layout(std430, binding = 0) readonly buffer Keys { uint keys[]; };
layout(std430, binding = 1) readonly buffer Ids { uint ids[]; };
layout(std430, binding = 2) readonly buffer Starts { uint starts[]; };
layout(std430, binding = 3) buffer Counts { uint counts[]; };
layout(std430, binding = 4) writeonly buffer Unordered { uint unordered[]; };
layout(std430, binding = 5) writeonly buffer SlotIds { uint slot_ids[]; };

layout(push_constant, scalar) uniform Push { CountingSortParams params; };

void main()
{
    const uint i = invocation_index();
    if (i < params.count && keys[i] < params.key_count) {
        const uint left = atomicAdd(counts[keys[i]], ~0u); // adds -1
        const uint slot = starts[keys[i]] + left - 1u;
        unordered[slot] = i;
        slot_ids[slot] = ids[i];
    }
}
