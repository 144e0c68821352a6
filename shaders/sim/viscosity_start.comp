#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// A viscosity solve begins: the change of velocity that it starts from is what viscosity did in the step before, and the first
// direction is the velocities with that. `before` still lies in the order before the sort. Twin: engine/reference/viscosity.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/sph_params.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Velocity { vec4 velocity[]; }; // w: mass
layout(set = 0, binding = 4, scalar) readonly buffer Before { vec4 before[]; };      // m/s^2
layout(set = 0, binding = 5, scalar) writeonly buffer Change { vec4 change[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer Direction { vec4 direction[]; };

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count) {
        return;
    }
    vec4 v = velocity[i];
    vec3 u = is_boundary(attributes[i]) ? vec3(0.0) : params.dt * before[order[i]].xyz;
    change[i] = vec4(u, 0.0);
    direction[i] = vec4(v.xyz + u, v.w);
}
