#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// What the change of velocity that a viscosity solve starts from leaves to be done, r = -dt K (v* + u) / m - u, and the inverse of
// each particle's block of A = 1 + dt K / m, the preconditioner: images of the particle itself are left out of it. `direction` is
// v* + u. Twin: engine/reference/viscosity.cpp.
#define CELL_START_BINDING 1
#define NEIGHBOR_BITS_BINDING 14
#define SUM_TYPE vec4
#define VISCOUS_BLOCKS true
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
layout(set = 0, binding = 9, scalar) readonly buffer Change { vec4 change[]; };
layout(set = 0, binding = 10, scalar) writeonly buffer Residual { vec4 residual[]; };
layout(set = 0, binding = 11, scalar) writeonly buffer Blocks { ViscosityBlock blocks[]; };
layout(set = 0, binding = 12, scalar) coherent buffer Sums { vec4 sums[]; };
layout(set = 0, binding = 13, scalar) coherent buffer State { ViscositySolve viscosity; };

#include "include/dispatch_sum.glsl"
#include "include/solve.glsl"
#include "include/viscosity_solve.glsl"
#include "include/viscous_walk.glsl"

ViscosityBlock invert(vec3 diagonal, vec3 off_diagonal)
{
    vec3 d = diagonal;
    vec3 o = off_diagonal;
    vec3 cofactors = d.yzx * d.zxy - o * o;
    vec3 off_cofactors = o.yzx * o.zxy - d * o;
    float determinant = d.x * cofactors.x + o.z * off_cofactors.z + o.y * off_cofactors.y;
    // Where rounding has left nothing of it, the diagonal alone serves.
    bool is_positive = determinant > 1e-6 * d.x * d.y * d.z && all(greaterThan(cofactors, vec3(0.0)));
    return is_positive ? ViscosityBlock(cofactors / determinant, off_cofactors / determinant) : ViscosityBlock(1.0 / d, vec3(0.0));
}

void main()
{
    vec4 sum = vec4(0.0); // m r.z, m r^2, m u^2, m v*^2
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
            vec4 w = direction[i];
            bool boundary = is_boundary(attributes[i]);
            float per_force = boundary ? 0.0 : params.dt * interaction[i].y / w.w;
            vec3 u = change[i].xyz;
            vec3 r = per_force * total[k].force - u; // a boundary particle's u is 0
            ViscosityBlock block = invert(1.0 + per_force * total[k].diagonal, per_force * total[k].off_diagonal);
            residual[i] = vec4(r, w.w);
            blocks[i] = block;
            vec3 start = w.xyz - u;
            sum += boundary ? vec4(0.0) : w.w * vec4(dot(r, precondition(block, r)), dot(r, r), dot(u, u), dot(start, start));
        }
    }
    if (dispatch_sum(sum)) {
        viscosity.turn = 0.0;
        viscosity.residual = sum.x;
        viscosity.momentum = sum.w;
        end_viscosity_iteration(sum.y, sum.z, 0u);
    }
}
