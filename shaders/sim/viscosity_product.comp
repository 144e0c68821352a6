#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// One iteration of a viscosity solve: A p = p + dt K p / m of the direction p, and how far to go in it. Twin:
// engine/reference/viscosity.cpp.
#define CELL_START_BINDING 1
#define NEIGHBOR_BITS_BINDING 12
#define SUM_TYPE float
#define WORKGROUP_SUMS sums
#define ARRIVED viscosity.solve.arrived
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "shared/particle_state.h"
#include "shared/viscosity_solve.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer Interaction { vec4 interaction[]; };
layout(set = 0, binding = 5) uniform textureBuffer interaction_texels;
layout(set = 0, binding = 6, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 7, scalar) readonly buffer Direction { vec4 direction[]; }; // w: mass
layout(set = 0, binding = 8) uniform textureBuffer direction_texels;
layout(set = 0, binding = 9, scalar) writeonly buffer Product { vec4 product[]; };
layout(set = 0, binding = 10, scalar) coherent buffer Sums { float sums[]; };
layout(set = 0, binding = 11, scalar) coherent buffer State { ViscositySolve viscosity; };

#include "include/dispatch_sum.glsl"
#include "include/viscous_walk.glsl"

void main()
{
    float sum = 0.0; // m p . A p
    if (invocation_index() * TILE < params.moving_count) {
        vec4 own[TILE];
        Tile tile = without_boundary(load_tile(invocation_index(), own));
        ViscousForce total[TILE];
        add_viscous_forces(own, tile, total);
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            uint i = tile.first + k;
            if (i > tile.last) {
                break;
            }
            vec4 p = direction[i];
            float per_force = is_boundary(attributes[i]) ? 0.0 : params.dt * interaction[i].y / p.w;
            vec3 q = p.xyz - per_force * total[k].force;
            product[i] = vec4(q, 0.0);
            sum += p.w * dot(p.xyz, q);
        }
    }
    if (dispatch_sum(sum)) {
        viscosity.advance = sum > 0.0 ? viscosity.residual / sum : 0.0;
    }
}
