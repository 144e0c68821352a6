#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// One iteration of a solve, first half: the velocities with what the pressures of the present iterate do in this step (Bender
// & Koschier 2015): v_i' = v_i + sum_j (X_i s_j + X_j s_i) g_ij / m_i with X = dt p V^2 and g_ij = -grad W_ij. This conserves
// momentum whatever the iterate. Boundary particles stay at rest. Twin: engine/reference/dfsph.cpp.
#define CELL_START_BINDING 1
#define NEIGHBOR_BITS_BINDING 9
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "include/sph_kernel.glsl"
#include "shared/particle_state.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer Interaction { vec4 interaction[]; };
layout(set = 0, binding = 5) uniform textureBuffer interaction_texels;
layout(set = 0, binding = 6, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 7, scalar) readonly buffer Velocity { vec4 velocity[]; };   // before the solve; w: mass
layout(set = 0, binding = 10) uniform textureBuffer velocity_texels;
layout(set = 0, binding = 8, scalar) writeonly buffer Corrected { vec4 corrected[]; }; // likewise

#include "include/boundary.glsl"
#include "include/image_walk.glsl"
#include "include/neighbor_bits.glsl"

void main()
{
    if (invocation_index() * TILE >= params.moving_count) {
        return;
    }
    vec4 own[TILE];
    Tile tile = without_boundary(load_tile(invocation_index(), own));

    KernelSize size = kernel_size(params.support_radius);
    float pressure_term[TILE]; // X gradient_scale
    vec3 impulse[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        pressure_term[k] = load_candidate(interaction, min(tile.first + k, tile.last)).x;
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
        FOR_EACH_NEIGHBOR(tile, walk, x, chunks, bits) {
            uint j = chunks.first + findLSB(bits);
            vec4 xj = load_candidate(position, j);
            float pressure_term_j = load_candidate(interaction, j).x;
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj.xyz;
                float r2 = dot(offset, offset);
                float shape = has_direction(r2, size) ? force_shapes(r2, size).x : 0.0;
                image_impulse[k] += (pressure_term[k] * xj.w + pressure_term_j) * shape * offset;
            }
        }
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            impulse[k] += image_signs(image) * image_impulse[k];
        }
    }
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = tile.first + k;
        if (i > tile.last) {
            break;
        }
        vec4 v = load_candidate(velocity, i);
        corrected[i] = is_boundary(attributes[i]) ? v : vec4(v.xyz + impulse[k] / v.w, v.w);
    }
}
