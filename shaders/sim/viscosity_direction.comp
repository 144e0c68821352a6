#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// One iteration of a viscosity solve: the next direction, the preconditioned residual and as much of the direction before as keeps
// the two conjugate. Twin: engine/reference/viscosity.cpp.
#include "include/invocation.glsl"
#include "include/viscosity_block.glsl"
#include "shared/sph_params.h"
#include "shared/viscosity_solve.h"

layout(constant_id = 1) const uint TILE = 1; // of the passes that the workgroups are counted for

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Residual { vec4 residual[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Blocks { ViscosityBlock blocks[]; };
layout(set = 0, binding = 3, scalar) readonly buffer State { ViscositySolve viscosity; };
layout(set = 0, binding = 4, scalar) buffer Direction { vec4 direction[]; };

void main()
{
    uint first = invocation_index() * TILE;
    for (uint i = first; i < min(first + TILE, params.moving_count); ++i) {
        vec3 z = precondition(blocks[i], residual[i].xyz);
        vec3 kept = viscosity.turn > 0.0 ? viscosity.turn * direction[i].xyz : vec3(0.0);
        direction[i] = vec4(z + kept, residual[i].w);
    }
}
