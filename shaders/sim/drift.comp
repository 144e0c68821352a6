#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// The end of a step whose velocities solves have made: x += v dt, with the walls' contact, the pressure that both solves found,
// and the watch. Twins: engine/reference/integrate.cpp, and solved_pressure in engine/reference/dfsph.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/solve.h"
#include "shared/sph_params.h"

layout(push_constant, scalar) uniform Push { uint step_index; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Interaction { vec4 interaction[]; };
layout(set = 0, binding = 3, scalar) readonly buffer WarmStart { vec2 warm_start[]; };
layout(set = 0, binding = 4, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 5, scalar) buffer Position { vec4 position[]; };
layout(set = 0, binding = 6, scalar) buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer Pressure { float pressure[]; };
layout(set = 0, binding = 8, scalar) buffer StatusBuffer { Status status; };

#include "include/contact.glsl"
#include "include/periodic.glsl"
#include "include/watch.glsl"

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count) {
        return;
    }
    if (is_boundary(attributes[i])) {
        pressure[i] = 0.0;
        return;
    }
    vec3 v = with_contact(position[i].xyz, velocity[i].xyz, params.dt);
    vec3 x = wrapped(position[i].xyz + params.dt * v);
    velocity[i].xyz = v;
    position[i].xyz = x;
    float volume = interaction[i].y;
    float impulse = warm_start[i][SOLVE_DENSITY] / params.dt + warm_start[i][SOLVE_DIVERGENCE]; // of both solves
    pressure[i] = impulse / (params.gradient_scale * params.dt * volume * volume);
    watch(i, x, v, step_index);
}
