#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// The curl of the velocity: omega_i = sum_j V_j (v_j - v_i) x g_ij over fluid and its images in the walls, with g_ij = -grad
// W_ij (Macklin & Mueller 2013, equation 15). Twin: engine/reference/vorticity.cpp.
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
layout(set = 0, binding = 9, scalar) writeonly buffer Vorticity { vec4 vorticity[]; }; // 1/s; w: V of fluid, else 0

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
    vec3 curl[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        v[k] = load_candidate(velocity, min(tile.first + k, tile.last)).xyz;
        curl[k] = vec3(0.0);
    }
    vec3 signs = vec3(1.0);
    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        vec3 flips = signs * image_signs(image);
        signs = image_signs(image);
        vec3 image_curl[TILE];
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            v[k] *= flips;
            image_curl[k] = vec3(0.0);
        }
        Walk walk = begin_walk(x);
        FOR_EACH_NEIGHBOR(tile, walk, x, chunks, bits) {
            uint j = chunks.first + findLSB(bits);
            vec3 xj = load_candidate(position, j).xyz;
            vec4 vj = load_candidate(velocity, j);
            float volume_j = vj.w > 0.0 ? load_candidate(interaction, j).y : 0.0;
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj;
                float r2 = dot(offset, offset);
                float shape = has_direction(r2, size) ? force_shapes(r2, size).x : 0.0;
                image_curl[k] += volume_j * shape * cross(vj.xyz - v[k], offset);
            }
        }
        // A curl is an axial vector: a mirror turns what lies in its plane around.
        float turn = signs.x * signs.y * signs.z;
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            curl[k] += turn * signs * image_curl[k];
        }
    }
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = tile.first + k;
        if (i > tile.last) {
            break;
        }
        bool boundary = is_boundary(attributes[i]);
        vorticity[i] = boundary ? vec4(0.0) : vec4(params.gradient_scale * curl[k], load_candidate(interaction, i).y);
    }
}
