#version 460
#extension GL_GOOGLE_include_directive : require
// How much of each exposed solid particle's surface is seen along a direction. Twin: engine/reference/visibility.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/sph_params.h"
#include "shared/visibility.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform View { VisibilityParams view; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Exposure { vec4 exposure[]; }; // by id: n, A in m^2
layout(set = 0, binding = 6, scalar) readonly buffer Map { uint map[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer Seen { float seen[]; }; // by id

#include "include/visibility.glsl"

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count || particle_state(attributes[i]) != STATE_SOLID) {
        return;
    }
    vec4 surface = exposure[id[i]];
    seen[id[i]] = surface.w > 0.0 ? seen_share(position[i].xyz, surface.xyz) : 0.0;
}
