// Counting sort, pass 4: within its key, an element's place is the number of smaller ids. Crowded keys are only listed.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/invocation.glsl"
#include "shared/counting_sort.h"

layout(std430, binding = 0) readonly buffer Keys { uint keys[]; };
layout(std430, binding = 1) readonly buffer Starts { uint starts[]; };
layout(std430, binding = 2) readonly buffer Unordered { uint unordered[]; };
layout(std430, binding = 3) readonly buffer SlotIds { uint slot_ids[]; };
layout(std430, binding = 4) writeonly buffer Order { uint order[]; };
layout(scalar, binding = 5) buffer Crowded
{
    CrowdedKeys crowded;
    uint crowded_keys[];
};

layout(push_constant, scalar) uniform Push { CountingSortParams params; };

void main()
{
    const uint slot = invocation_index();
    if (slot >= starts[params.key_count]) {
        return;
    }
    const uint element = unordered[slot];
    const uint key = keys[element];
    const uint first = starts[key];
    const uint end = starts[key + 1u];
    if (end - first > CROWDED_KEY) {
        if (slot == first) {
            crowded_keys[atomicAdd(crowded.count, 1u)] = key;
        }
        return;
    }
    const uint id = slot_ids[slot];
    uint place = first;
    for (uint i = first; i < end; ++i) {
        place += slot_ids[i] < id ? 1u : 0u;
    }
    order[place] = element;
}
