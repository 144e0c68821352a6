#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// The forces of surface tension: shared/capillarity.h, step 3. Twin: engine/reference/capillarity.cpp.
#define CELL_START_BINDING 1
#define NEIGHBOR_BITS_BINDING 13
#include "include/candidate.glsl"
#include "include/capillarity.glsl"
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
layout(set = 0, binding = 8, scalar) readonly buffer Normal { vec4 normal[]; }; // smoothed, 1/m; w: sigma, 0 of boundary particles
layout(set = 0, binding = 9) uniform textureBuffer normal_texels;
layout(set = 0, binding = 10, scalar) readonly buffer Gradient { vec4 gradient[]; };
layout(set = 0, binding = 11, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 12, scalar) buffer Acceleration { vec4 acceleration[]; };

#include "include/boundary.glsl"
#include "include/image_walk.glsl"
#include "include/neighbor_bits.glsl"

// How far below the surface a particle lies, in spacings: what its normal tells of it between the two outermost layers of a
// lattice, half a spacing and one and a half deep.
float depth(vec3 its_normal)
{
    float steepness = length(its_normal) * params.support_radius;
    return 0.5 + clamp((params.first_layer_steepness - steepness) / (params.first_layer_steepness - params.second_layer_steepness), 0.0, 1.0);
}

// 0 in the fluid and at its surfaces, 1 of a particle with next to no neighbors.
float looseness(float volume)
{
    return clamp((LOOSE_FILLING - params.lattice_volume / volume) / (LOOSE_FILLING - LEAST_FILLING), 0.0, 1.0);
}

// The curvature of the surface, from that of the parallel surface so far below; 1/m. At most that of a drop one support radius in
// radius: finer ones are not resolved.
float surface_curvature(float below, float deep)
{
    float turn = below * deep * params.spacing / float(DIMENSIONS - 1u);
    float surface = below / (1.0 + max(turn, -0.5));
    float most = float(DIMENSIONS - 1u) / params.support_radius;
    return clamp(surface, -most, most);
}

void main()
{
    if (invocation_index() * TILE >= params.moving_count) {
        return;
    }
    vec4 own[TILE];
    Tile tile = without_boundary(load_tile(invocation_index(), own));

    KernelSize size = kernel_size(params.support_radius);
    float crowding_distance = CROWDING_DISTANCE * params.spacing;
    float crowding = params.lattice_volume / (params.spacing * params.spacing); // d; in two dimensions 1
    vec3 v[TILE]; // as the present image has it
    float volume[TILE];
    float density[TILE];
    vec3 out_of[TILE]; // its outward normal
    float sigma[TILE];
    float at_surface[TILE];
    float loose[TILE];
    vec3 force[TILE];
    float turning[TILE]; // sums of w_ij (m_j - m_i) . x_ji, w_ij |x_ji|^2 and what of it lies along the surface
    float spread[TILE];
    float spread_along[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = min(tile.first + k, tile.last);
        vec4 its_velocity = load_candidate(velocity, i);
        vec4 its_normal = load_candidate(normal, i);
        v[k] = its_velocity.xyz;
        volume[k] = load_candidate(interaction, i).y;
        density[k] = its_velocity.w / volume[k];
        out_of[k] = outward(its_normal.xyz);
        sigma[k] = its_normal.w;
        at_surface[k] = surface_share(its_normal.xyz, params.support_radius);
        loose[k] = looseness(volume[k]);
        force[k] = vec3(0.0);
        turning[k] = spread[k] = spread_along[k] = 0.0;
    }

    vec3 signs = vec3(1.0);
    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        vec3 flips = signs * image_signs(image);
        signs = image_signs(image);
        float shown = shows_normals(signs);
        vec3 image_force[TILE];
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            v[k] *= flips;
            image_force[k] = vec3(0.0);
        }
        Walk walk = begin_walk(x);
        FOR_EACH_NEIGHBOR(tile, walk, x, chunks, bits) {
            uint j = chunks.first + findLSB(bits);
            vec3 xj = load_candidate(position, j).xyz;
            vec4 velocity_j = load_candidate(velocity, j);
            float volume_j = load_candidate(interaction, j).y;
            vec4 normal_j = load_candidate(normal, j);
            vec3 out_of_j = outward(normal_j.xyz);
            float at_surface_j = surface_share(normal_j.xyz, params.support_radius);
            float counts = normal_j.w > 0.0 ? 1.0 : 0.0;
            float loose_j = looseness(volume_j);
            float density_j = velocity_j.w > 0.0 ? velocity_j.w / volume_j : 0.0; // dust has neither mass nor volume
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = xj - x[k];
                float r2 = dot(offset, offset);
                float r = sqrt(max(r2, size.coincident2));
                float u = max(1.0 - r * size.inverse_h, 0.0);
                float w = shown * at_surface_j * u * u;
                float across = dot(offset, out_of[k]);
                turning[k] += w * dot(out_of_j - out_of[k], offset);
                spread[k] += w * r2;
                spread_along[k] += w * (r2 - across * across);

                float mean_sigma = counts * 0.5 * (sigma[k] + normal_j.w);
                float apart = clamp((r - params.spacing) / (params.support_radius - params.spacing), 0.0, 1.0);
                float cling = max(loose[k], loose_j) * 4.0 * apart * (1.0 - apart);
                float push = mean_sigma * crowding * (max(1.0 - r / crowding_distance, 0.0) - cling);
                image_force[k] -= has_direction(r2, size) ? push / r * offset : vec3(0.0);
                float mean_density = 0.5 * (density[k] + density_j);
                float drag = SURFACE_DRAG * sqrt(mean_sigma * mean_density * params.spacing) * max(at_surface[k], at_surface_j);
                float laplacian = params.viscosity_scale * force_shapes(r2, size).y;
                image_force[k] += drag * volume[k] * volume_j * laplacian * (velocity_j.xyz - v[k]);
            }
        }
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            force[k] += signs * image_force[k];
        }
    }

    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = tile.first + k;
        if (i > tile.last) {
            break;
        }
        if (sigma[k] > 0.0) {
            float along = max(spread_along[k], LEAST_SPREAD * spread[k]);
            float below = along > 0.0 ? float(DIMENSIONS - 1u) * turning[k] / along : 0.0;
            float curvature = at_surface[k] * surface_curvature(below, depth(normal[i].xyz));
            vec3 a = 2.0 * sigma[k] * curvature / density[k] * gradient[i].xyz;
            acceleration[i].xyz += a + force[k] / (density[k] * volume[k]);
        }
    }
}
