#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// The begin of a step of position based fluids: where the velocities lead to, x += v dt, held off the walls. The neighbors of a
// step are those of these positions. Twin: engine/reference/pbf.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/sph_params.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 2, scalar) buffer Position { vec4 position[]; };
layout(set = 0, binding = 3, scalar) buffer Velocity { vec4 velocity[]; };

#include "include/contact.glsl"
#include "include/periodic.glsl"

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count || is_boundary(attributes[i])) {
        return;
    }
    vec3 v = with_contact(position[i].xyz, velocity[i].xyz, params.dt);
    velocity[i].xyz = v;
    position[i].xyz = wrapped(position[i].xyz + params.dt * v);
}
