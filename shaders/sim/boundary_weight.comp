#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// The weight of colliders' particles: s_b = V_b / d^3 with V_b = 1 / sum_k W_bk over such particles and their images in
// the walls (Akinci et al. 2012), so that a surface has the same effect however densely it is sampled, or unevenly. Solids are
// filled with particles, whose weight is 1 as in a fluid. Twin: engine/reference/boundary.cpp.
#define CELL_START_BINDING 1
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "include/sph_kernel.glsl"
#include "shared/particle_state.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer Weighted { vec4 weighted[]; }; // the positions, with their weights

#include "include/boundary.glsl"
#include "include/image_walk.glsl"

void main()
{
    if (invocation_index() * TILE >= params.pool_count) {
        return;
    }
    vec4 own[TILE];
    Tile tile = only_boundary(load_tile_of(0u, params.pool_count, invocation_index(), own));

    KernelSize size = kernel_size(params.support_radius);
    float sum[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        sum[k] = 0.0;
    }
    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        Walk walk = begin_walk(x);
        FOR_EACH_CANDIDATE(range, walk) {
            vec3 xj = load_candidate(position, range.x).xyz;
            float counts = particle_state(attributes[range.x]) == STATE_COLLIDER ? 1.0 : 0.0;
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj;
                sum[k] += counts * density_shape(dot(offset, offset), size);
            }
        }
    }

    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = tile.first + k;
        if (i > tile.last) {
            break;
        }
        float weight = particle_state(attributes[i]) == STATE_COLLIDER ? 1.0 / (params.lattice_volume * params.density_scale * sum[k]) : own[k].w;
        weighted[i] = vec4(own[k].xyz, weight);
    }
}
