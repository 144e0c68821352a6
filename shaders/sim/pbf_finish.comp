#version 460
#extension GL_GOOGLE_include_directive : require
// The end of a step of position based fluids: the velocities that the moves amount to, no faster than the speed cap, the
// positions, the pressure that the moves stand for, and the watch. Velocities get what the moves add, and are not made anew from
// the difference of two positions, whose rounding would show. Twin: engine/reference/pbf.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/solve.h"
#include "shared/sph_params.h"

layout(push_constant, scalar) uniform Push { uint step_index; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 2, scalar) buffer Interaction { vec4 interaction[]; }; // of shared/sph_params.h
layout(set = 0, binding = 3, scalar) readonly buffer Move { vec4 move[]; };
layout(set = 0, binding = 4, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 5, scalar) buffer Position { vec4 position[]; };
layout(set = 0, binding = 6, scalar) buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 7, scalar) buffer Pressure { float pressure[]; };
layout(set = 0, binding = 8, scalar) buffer StatusBuffer { Status status; };
layout(set = 0, binding = 9, scalar) buffer Solves { Solve solves[SOLVES]; };

#include "include/periodic.glsl"
#include "include/watch.glsl"

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count || is_boundary(attributes[i])) {
        return;
    }
    vec3 its_move = move[i].xyz;
    uint squared_move = floatBitsToUint(dot(its_move, its_move)); // floats that are not negative sort like their bits
    if (squared_move > solves[SOLVE_DENSITY].farthest) {
        atomicMax(solves[SOLVE_DENSITY].farthest, squared_move);
    }
    vec3 v = velocity[i].xyz + its_move / params.dt;
    float limit = params.speed_cap / params.dt;
    float speed = length(v);
    if (speed > limit) {
        v *= limit / speed;
        its_move = params.dt * (v - velocity[i].xyz);
        atomicAdd(solves[SOLVE_DENSITY].capped, 1u);
    }
    vec3 x = wrapped(position[i].xyz + its_move);
    velocity[i].xyz = v;
    position[i].xyz = x;
    float volume = interaction[i].y;
    interaction[i].x = pressure[i] / (params.dt * params.dt); // for its reaction on loose solids
    pressure[i] = interaction[i].x / (params.gradient_scale * volume * volume);
    watch(i, x, v, step_index);
}
