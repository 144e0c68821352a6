#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Smooths normals: shared/capillarity.h, step 2. Twin: engine/reference/capillarity.cpp.
#define CELL_START_BINDING 1
#define NEIGHBOR_BITS_BINDING 8
#include "include/candidate.glsl"
#include "include/capillarity.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "include/sph_kernel.glsl"
#include "shared/particle_state.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer Normal { vec4 normal[]; }; // 1/m; w: sigma, 0 where there is none to smooth
layout(set = 0, binding = 5) uniform textureBuffer normal_texels;
layout(set = 0, binding = 6, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer Smoothed { vec4 smoothed[]; };

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
    vec4 sum[TILE]; // of W n_j, and of W
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        sum[k] = vec4(0.0);
    }
    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        float shown = shows_normals(image_signs(image));
        Walk walk = begin_walk(x);
        FOR_EACH_NEIGHBOR(tile, walk, x, chunks, bits) {
            uint j = chunks.first + findLSB(bits);
            vec3 xj = load_candidate(position, j).xyz;
            vec4 normal_j = load_candidate(normal, j);
            float counts = normal_j.w > 0.0 ? shown : 0.0;
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj;
                float share = counts * density_shape(dot(offset, offset), size);
                sum[k] += share * vec4(normal_j.xyz, 1.0);
            }
        }
    }
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = tile.first + k;
        if (i > tile.last) {
            break;
        }
        float sigma = normal[i].w;
        smoothed[i] = sigma > 0.0 ? vec4(sum[k].xyz / sum[k].w, sigma) : vec4(0.0);
    }
}
