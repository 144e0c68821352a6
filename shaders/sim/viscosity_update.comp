#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// One iteration of a viscosity solve, its end: the change of velocity and the residual after a step along the direction, and
// whether there is a next iteration. Twin: engine/reference/viscosity.cpp.
#define SUM_TYPE vec3
#define WORKGROUP_SUMS sums
#define ARRIVED viscosity.solve.arrived
#include "include/invocation.glsl"
#include "shared/sph_params.h"
#include "shared/viscosity_solve.h"

layout(constant_id = 1) const uint TILE = 1; // of the passes that the workgroups are counted for

layout(push_constant, scalar) uniform Push { uint iteration; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Direction { vec4 direction[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Product { vec4 product[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Blocks { ViscosityBlock blocks[]; };
layout(set = 0, binding = 4, scalar) buffer Change { vec4 change[]; };
layout(set = 0, binding = 5, scalar) buffer Residual { vec4 residual[]; };
layout(set = 0, binding = 6, scalar) coherent buffer Sums { vec3 sums[]; };
layout(set = 0, binding = 7, scalar) coherent buffer State { ViscositySolve viscosity; };

#include "include/dispatch_sum.glsl"
#include "include/viscosity_solve.glsl"

void main()
{
    vec3 sum = vec3(0.0); // m r.z, m r^2, m u^2
    uint first = invocation_index() * TILE;
    for (uint i = first; i < min(first + TILE, params.moving_count); ++i) {
        vec3 u = change[i].xyz + viscosity.advance * direction[i].xyz;
        vec3 r = residual[i].xyz - viscosity.advance * product[i].xyz;
        float mass = residual[i].w;
        change[i] = vec4(u, 0.0);
        residual[i] = vec4(r, mass);
        sum += mass * vec3(dot(r, precondition(blocks[i], r)), dot(r, r), dot(u, u));
    }
    if (dispatch_sum(sum)) {
        viscosity.turn = viscosity.residual > 0.0 ? sum.x / viscosity.residual : 0.0;
        viscosity.residual = sum.x;
        end_viscosity_iteration(sum.y, sum.z, iteration);
    }
}
