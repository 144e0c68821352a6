#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// The reaction to a step's solves on boundary particles, added to what steps before have left: X_j s_b g_bj with the impulses
// X = dt p V^2 that both solves have ended with, of the fluid and its images in the walls (Bender & Koschier 2015; Akinci et al.
// 2012). It has the momentum that dfsph_correct.comp took from the fluid. Twin: engine/reference/boundary_force.cpp.
#define CELL_START_BINDING 1
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "include/sph_kernel.glsl"
#include "shared/particle_state.h"
#include "shared/reaction.h"
#include "shared/solve.h"

layout(push_constant, scalar) uniform Push { ReactionPush push; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer WarmStart { vec2 warm_start[]; }; // by SOLVE_*, as dfsph_residual.comp leaves it
layout(set = 0, binding = 5, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 7, scalar) buffer Reactions { Reaction reactions[]; }; // by id

#include "include/boundary.glsl"
#include "include/image_walk.glsl"

void main()
{
    if (invocation_index() * TILE >= push.count) {
        return;
    }
    vec4 own[TILE];
    Tile tile = only_boundary(load_tile_of(0u, push.count, invocation_index(), own));

    KernelSize size = kernel_size(params.support_radius);
    vec3 impulse[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        impulse[k] = vec3(0.0);
    }
    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        vec3 image_impulse[TILE];
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            image_impulse[k] = vec3(0.0);
        }
        Walk walk = begin_walk(x);
        FOR_EACH_CANDIDATE(range, walk) {
            vec3 xj = load_candidate(position, range.x).xyz;
            vec2 of_solves = warm_start[range.x];
            float impulse_j = of_solves[SOLVE_DIVERGENCE] + of_solves[SOLVE_DENSITY] / params.dt;
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj;
                float r2 = dot(offset, offset);
                image_impulse[k] += (has_direction(r2, size) ? impulse_j * force_shapes(r2, size).x : 0.0) * offset;
            }
        }
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            impulse[k] += image_signs(image) * image_impulse[k];
        }
    }

    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = tile.first + k;
        if (i <= tile.last && is_boundary(attributes[i])) {
            reactions[id[i] - push.first_id].pressure += own[k].w * impulse[k];
        }
    }
}
