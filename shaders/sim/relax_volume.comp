#version 460
#extension GL_GOOGLE_include_directive : require
// Fluid that was a solid of another density takes on a fluid's volume (shared/volume_relaxation.h). Twin:
// engine/reference/volume_relaxation.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/sph_params.h"
#include "shared/volume_relaxation.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 2, scalar) buffer Position { vec4 position[]; }; // w: weight

void main()
{
    uint i = invocation_index();
    if (i < params.moving_count && particle_state(attributes[i]) == STATE_FLUID) {
        position[i].w = relaxed_weight(position[i].w);
    }
}
