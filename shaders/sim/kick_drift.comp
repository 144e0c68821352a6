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

bool is_outside(vec3 x) { return any(lessThan(x, params.domain_min)) || any(greaterThan(x, params.domain_max)); }

uint find_fault(vec3 x, vec3 v)
{
    if (any(isnan(x)) || any(isinf(x)) || any(isnan(v)) || any(isinf(v))) {
        return FAULT_NOT_FINITE;
    }
    if (is_outside(x)) {
        return FAULT_ESCAPED;
    }
    return dot(v, v) > params.speed_limit * params.speed_limit ? FAULT_TOO_FAST : FAULT_NONE;
}

void main()
{
    uint i = invocation_index();
    if (i >= params.particle_count || is_boundary(attributes[i])) {
        return;
    }
    vec3 v = load_candidate(velocity, i).xyz + 0.5 * params.dt * load_candidate(acceleration, i).xyz;
    vec3 x = load_candidate(position, i).xyz + params.dt * v;
    velocity[i].xyz = v;
    position[i].xyz = x;

    if (is_outside(x)) {
        attributes[i] |= FLAG_LEFT_DOMAIN;
    }
    uint fault = find_fault(x, v);
    if (fault == FAULT_NONE) {
        return;
    }
    // Steps run one after the other: an earlier faulty step has already left a smaller number.
    if (atomicMin(status.first_faulty_step, step_index) >= step_index) {
        atomicMin(status.offender, pack_offender(id[i], fault));
    }
}
