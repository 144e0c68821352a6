#version 460
#extension GL_GOOGLE_include_directive : require
// Brings an array of so many words a particle into the order of the last sort, whatever they mean.
#include "include/invocation.glsl"
#include "shared/gather.h"

layout(push_constant, scalar) uniform Push { GatherPush push; };
layout(set = 0, binding = 0, scalar) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Source { uint source[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Target { uint target[]; };

void main()
{
    uint slot = invocation_index();
    if (slot >= push.count) {
        return;
    }
    for (uint k = 0u; k < push.words; ++k) {
        target[slot * push.words + k] = source[order[slot] * push.words + k];
    }
}
