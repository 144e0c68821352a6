#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// One iteration of position based fluids, second half: adds to each particle's move what the violated constraints around it ask
// for, and the artificial pressure (shared/pbf.h). Boundary particles stay. Twin: engine/reference/pbf.cpp.
#define CELL_START_BINDING 1
#define NEIGHBOR_BITS_BINDING 12
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "include/sph_kernel.glsl"
#include "shared/particle_state.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; }; // when the grid was made
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer Moved { vec4 moved[]; }; // now; w: weight
layout(set = 0, binding = 5) uniform textureBuffer moved_texels;
layout(set = 0, binding = 6, scalar) readonly buffer Interaction { vec4 interaction[]; };
layout(set = 0, binding = 7) uniform textureBuffer interaction_texels;
layout(set = 0, binding = 8, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 9, scalar) readonly buffer Velocity { vec4 velocity[]; }; // w: mass
layout(set = 0, binding = 10, scalar) buffer Move { vec4 move[]; };
layout(set = 0, binding = 11, scalar) buffer Pressure { float pressure[]; }; // sum of X gradient_scale over the iterations

#include "include/boundary.glsl"
#include "include/moved_walk.glsl"

void main()
{
    if (invocation_index() * TILE >= params.moving_count) {
        return;
    }
    vec4 own[TILE];
    Tile tile = without_boundary(load_tile(invocation_index(), own));

    KernelSize size = kernel_size(params.support_radius);
    vec4 now[TILE];
    load_moved(tile, now);
    vec2 terms[TILE]; // X gradient_scale; the artificial pressure's
    vec3 change[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        terms[k] = load_candidate(interaction, min(tile.first + k, tile.last)).xw;
        change[k] = vec3(0.0);
    }
    FOR_EACH_IMAGE(image, tile) {
        vec3 x_then[TILE];
        vec3 x[TILE];
        image_positions(tile, own, image, x_then);
        moved_image_positions(own, now, image, x);
        vec3 image_change[TILE];
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            image_change[k] = vec3(0.0);
        }
        Walk walk = begin_walk(x_then);
        FOR_EACH_NEIGHBOR(tile, walk, x_then, chunks, bits) {
            uint j = chunks.first + findLSB(bits);
            vec3 xj_then = load_candidate(position, j).xyz;
            vec4 xj = load_candidate(moved, j);
            vec2 terms_j = load_candidate(interaction, j).xw;
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj.xyz;
                float r2 = dot(offset, offset);
                bool neighbors = were_neighbors(x_then[k], xj_then) && has_direction(r2, size);
                float shape = neighbors ? force_shapes(r2, size).x : 0.0;
                float near = params.artificial_pressure_scale * density_shape(r2, size);
                near *= near;
                vec2 both = terms[k] * xj.w + terms_j;
                image_change[k] += (both.x + both.y * near * near) * shape * offset;
            }
        }
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            change[k] += image_signs(image) * image_change[k];
        }
    }
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = tile.first + k;
        if (i > tile.last) {
            break;
        }
        if (!is_boundary(attributes[i])) {
            move[i].xyz += change[k] / velocity[i].w;
            pressure[i] += terms[k].x;
        }
    }
}
