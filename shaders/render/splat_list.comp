#version 460
#extension GL_GOOGLE_include_directive : require
// The splats that are to be drawn, in their order, and the arguments of the draw.
#include "include/invocation.glsl"
#include "shared/render_params.h"

layout(push_constant) uniform Push { uint count; };
layout(set = 0, binding = 0, scalar) readonly buffer Flags { uint flags[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Starts { uint starts[]; }; // sums of the flags before each, and of all
layout(set = 0, binding = 2, scalar) writeonly buffer List { uint list[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Arguments { DrawArguments arguments; };

void main()
{
    uint i = invocation_index();
    if (i == 0u) {
        arguments = DrawArguments(VERTICES_PER_QUAD * starts[count], 1u, 0u, 0u);
    }
    if (i < count && flags[i] != 0u) {
        list[starts[i]] = i;
    }
}
