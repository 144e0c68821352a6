#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Vorticity confinement (Macklin & Mueller 2013, equation 16; Fedkiw, Stam & Jensen 2001): a_i += epsilon N x omega_i with
// N = eta / |eta| and eta = grad |omega| = -sum_j V_j (|omega_j| - |omega_i|) g_ij over fluid and its images in the walls. It
// spins vortices up, and conserves no momentum. Twin: engine/reference/vorticity.cpp.
#define CELL_START_BINDING 1
#define NEIGHBOR_BITS_BINDING 8
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "include/sph_kernel.glsl"
#include "shared/particle_state.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer Vorticity { vec4 vorticity[]; }; // w: V of fluid, else 0
layout(set = 0, binding = 5) uniform textureBuffer vorticity_texels;
layout(set = 0, binding = 6, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 7, scalar) buffer Acceleration { vec4 acceleration[]; };

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
    float strength[TILE]; // |omega|
    vec3 rise[TILE];      // eta / gradient_scale
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        strength[k] = length(load_candidate(vorticity, min(tile.first + k, tile.last)).xyz);
        rise[k] = vec3(0.0);
    }
    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        vec3 image_rise[TILE];
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            image_rise[k] = vec3(0.0);
        }
        Walk walk = begin_walk(x);
        FOR_EACH_NEIGHBOR(tile, walk, x, chunks, bits) {
            uint j = chunks.first + findLSB(bits);
            vec3 xj = load_candidate(position, j).xyz;
            vec4 vorticity_j = load_candidate(vorticity, j);
            float strength_j = length(vorticity_j.xyz);
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj;
                float r2 = dot(offset, offset);
                float shape = has_direction(r2, size) ? force_shapes(r2, size).x : 0.0;
                image_rise[k] -= vorticity_j.w * (strength_j - strength[k]) * shape * offset;
            }
        }
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            rise[k] += image_signs(image) * image_rise[k];
        }
    }
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = tile.first + k;
        if (i > tile.last) {
            break;
        }
        if (!is_boundary(attributes[i])) {
            vec3 eta = params.gradient_scale * rise[k];
            float least = FLAT_VORTICITY * strength[k] / params.support_radius;
            float length_of_eta = length(eta) + least;
            vec3 n = length_of_eta > 0.0 ? eta / length_of_eta : vec3(0.0);
            acceleration[i].xyz += params.vorticity_confinement * cross(n, vorticity[i].xyz);
        }
    }
}
