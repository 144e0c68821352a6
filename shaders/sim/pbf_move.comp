#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Where the particles are now, in an iteration of position based fluids: the predicted positions and the move since, which
// begins with what the accelerations do in this step. Both are held off the walls. Twin: engine/reference/pbf.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/sph_params.h"

layout(constant_id = 1) const uint TILE = 1; // particles an invocation: the workgroups are those of the iteration's other passes

layout(push_constant, scalar) uniform Push { uint iteration; }; // 0: before the first
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Position { vec4 position[]; }; // predicted
layout(set = 0, binding = 2, scalar) readonly buffer Acceleration { vec4 acceleration[]; };
layout(set = 0, binding = 3, scalar) buffer Move { vec4 move[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Moved { vec4 moved[]; };       // xyz: present position, w: weight
layout(set = 0, binding = 5, scalar) writeonly buffer Pressure { float pressure[]; }; // its sum over iterations

#include "include/contact.glsl"

void main()
{
    uint first = invocation_index() * TILE;
    uint end = min(first + TILE, params.moving_count);
    for (uint i = first; i < end; ++i) {
        vec4 its_position = position[i];
        vec3 its_move = move[i].xyz;
        if (iteration == 0u) {
            its_move = params.dt * params.dt * acceleration[i].xyz; // none for boundary particles
            pressure[i] = 0.0;
        }
        its_move = with_contact(its_position.xyz, its_move, 1.0);
        move[i] = vec4(its_move, 0.0);
        moved[i] = vec4(its_position.xyz + its_move, its_position.w);
    }
}
