#version 460
#extension GL_GOOGLE_include_directive : require
// How many of the moving particles are dead, and will not be among them any more.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/pool_changes.h"
#include "shared/sph_params.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 2, scalar) buffer Changes { PoolChanges changes; };

void main()
{
    uint i = invocation_index();
    if (i < params.moving_count && is_gone(attributes[i])) {
        atomicAdd(changes.died, 1u);
    }
}
