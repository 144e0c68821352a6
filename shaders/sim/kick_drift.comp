#version 460
#extension GL_GOOGLE_include_directive : require
// First half of velocity Verlet (Swope et al. 1982): v += a dt/2, x += v dt; and the watch over what may go wrong. The velocity
// that it leaves is the half-step velocity that the forces see. Twin: engine/reference/integrate.cpp.
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/sph_params.h"

layout(push_constant, scalar) uniform Push { uint step_index; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Acceleration { vec4 acceleration[]; };
layout(set = 0, binding = 3) uniform textureBuffer acceleration_texels;
layout(set = 0, binding = 4, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 5, scalar) buffer Position { vec4 position[]; };
layout(set = 0, binding = 6) uniform textureBuffer position_texels;
layout(set = 0, binding = 7, scalar) buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 8) uniform textureBuffer velocity_texels;
layout(set = 0, binding = 9, scalar) buffer StatusBuffer { Status status; };

#include "include/periodic.glsl"
#include "include/watch.glsl"

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count || is_boundary(attributes[i])) {
        return;
    }
    vec3 v = load_candidate(velocity, i).xyz + 0.5 * params.dt * load_candidate(acceleration, i).xyz;
    vec3 x = wrapped(load_candidate(position, i).xyz + params.dt * v);
    velocity[i].xyz = v;
    position[i].xyz = x;
    watch(i, x, v, step_index);
}
