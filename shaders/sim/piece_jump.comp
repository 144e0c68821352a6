#version 460
#extension GL_GOOGLE_include_directive : require
// A round of the search for pieces, second half: who is called like another takes on that one's own name, several times over.
#include "include/invocation.glsl"
#include "shared/rigid.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) coherent buffer Label { uint label[]; }; // by id

const uint JUMPS = 4u; // lead on by as many as 16 names

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count || label[i] == NO_PIECE) {
        return;
    }
    uint name = label[i];
    for (uint jump = 0u; jump < JUMPS; ++jump) {
        name = label[name];
    }
    atomicMin(label[i], name);
}
