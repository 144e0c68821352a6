#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// XSPH: velocities nearer to those of the fluid around (Schechter & Bridson 2012, after Monaghan 1989), v_i' = v_i +
// c sum_j 2 m_j / (rho_i + rho_j) (v_j - v_i) W_ij over fluid and its images in the walls. What i takes j gives: momentum is
// conserved. Twin: engine/reference/vorticity.cpp.
#define CELL_START_BINDING 1
#define NEIGHBOR_BITS_BINDING 10
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "include/sph_kernel.glsl"
#include "shared/particle_state.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer Velocity { vec4 velocity[]; }; // w: mass
layout(set = 0, binding = 5) uniform textureBuffer velocity_texels;
layout(set = 0, binding = 6, scalar) readonly buffer Interaction { vec4 interaction[]; }; // y: V
layout(set = 0, binding = 7) uniform textureBuffer interaction_texels;
layout(set = 0, binding = 8, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 9, scalar) writeonly buffer Smoothed { vec4 smoothed[]; }; // velocities; w: mass

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
    vec3 v[TILE]; // as the present image has it
    float density[TILE];
    vec3 change[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = min(tile.first + k, tile.last);
        vec4 its_velocity = load_candidate(velocity, i);
        v[k] = its_velocity.xyz;
        density[k] = its_velocity.w / load_candidate(interaction, i).y;
        change[k] = vec3(0.0);
    }
    vec3 signs = vec3(1.0);
    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        vec3 flips = signs * image_signs(image);
        signs = image_signs(image);
        vec3 image_change[TILE];
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            v[k] *= flips;
            image_change[k] = vec3(0.0);
        }
        Walk walk = begin_walk(x);
        FOR_EACH_NEIGHBOR(tile, walk, x, chunks, bits) {
            uint j = chunks.first + findLSB(bits);
            vec3 xj = load_candidate(position, j).xyz;
            vec4 vj = load_candidate(velocity, j); // w: boundary particles respond with none, dust has no volume either
            float density_j = vj.w > 0.0 ? vj.w / load_candidate(interaction, j).y : 0.0;
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj;
                float share = max(vj.w, 0.0) / (density[k] + density_j) * density_shape(dot(offset, offset), size);
                image_change[k] += share * (vj.xyz - v[k]);
            }
        }
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            change[k] += signs * image_change[k];
        }
    }
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = tile.first + k;
        if (i > tile.last) {
            break;
        }
        vec4 its_velocity = velocity[i];
        vec3 its_change = 2.0 * params.xsph * params.density_scale * change[k];
        smoothed[i] = vec4(its_velocity.xyz + (is_boundary(attributes[i]) ? vec3(0.0) : its_change), its_velocity.w);
    }
}
