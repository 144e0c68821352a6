#version 460
#extension GL_GOOGLE_include_directive : require
// Moves the particles into the sorted order, so that neighbors in space are neighbors in memory. What the rest of the step
// computes anew (density, pressure, acceleration) stays behind.
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "shared/prelude.h"

layout(push_constant, scalar) uniform Push { uint count; };
layout(set = 0, binding = 0, scalar) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 4) uniform textureBuffer position_texels;
layout(set = 0, binding = 5, scalar) readonly buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 6) uniform textureBuffer velocity_texels;
layout(set = 0, binding = 7, scalar) writeonly buffer SortedId { uint sorted_id[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer SortedAttributes { uint sorted_attributes[]; };
layout(set = 0, binding = 9, scalar) writeonly buffer SortedPosition { vec4 sorted_position[]; };
layout(set = 0, binding = 10, scalar) writeonly buffer SortedVelocity { vec4 sorted_velocity[]; };

void main()
{
    uint slot = invocation_index();
    if (slot >= count) {
        return;
    }
    uint source = order[slot];
    sorted_id[slot] = id[source];
    sorted_attributes[slot] = attributes[source];
    sorted_position[slot] = load_candidate(position, source);
    sorted_velocity[slot] = load_candidate(velocity, source);
}
