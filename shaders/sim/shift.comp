#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Particle shifting (Lind, Xu, Stansby & Rogers 2012): particles diffuse to where there are fewer, x_i -= D dt grad C_i with
// grad C_i = sum_j V_j (1 + 0.2 (W_ij / W(d))^4) grad W_ij over the particles and their images, by at most SHIFT_CAP spacings.
// Velocities stay with the particles. Twin: engine/reference/shifting.cpp.
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
layout(set = 0, binding = 4, scalar) readonly buffer Interaction { vec4 interaction[]; }; // y: V
layout(set = 0, binding = 5) uniform textureBuffer interaction_texels;
layout(set = 0, binding = 6, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer Shifted { vec4 shifted[]; }; // positions; w: weight

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
    vec3 descent[TILE]; // -grad C / gradient_scale
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        descent[k] = vec3(0.0);
    }
    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        vec3 image_descent[TILE];
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            image_descent[k] = vec3(0.0);
        }
        Walk walk = begin_walk(x);
        FOR_EACH_NEIGHBOR(tile, walk, x, chunks, bits) {
            uint j = chunks.first + findLSB(bits);
            vec3 xj = load_candidate(position, j).xyz;
            float volume_j = load_candidate(interaction, j).y;
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj;
                float r2 = dot(offset, offset);
                float shape = has_direction(r2, size) ? force_shapes(r2, size).x : 0.0;
                float near = params.shifting_scale * density_shape(r2, size);
                near *= near;
                image_descent[k] += volume_j * (1.0 + SHIFT_NEAR * near * near) * shape * offset;
            }
        }
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            descent[k] += image_signs(image) * image_descent[k];
        }
    }
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = tile.first + k;
        if (i > tile.last) {
            break;
        }
        vec3 shift = params.shifting * params.dt * params.gradient_scale * descent[k];
        float longest = SHIFT_CAP * params.spacing;
        float distance = length(shift);
        shift *= distance > longest ? longest / distance : 1.0;
        vec3 x = is_boundary(attributes[i]) ? own[k].xyz : wrapped(own[k].xyz + shift);
        shifted[i] = vec4(x, own[k].w);
    }
}
