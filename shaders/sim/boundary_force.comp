#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// The reaction to forces.comp on boundary particles, times the time step, added to what steps before have left: pressure
// p_j V_j^2 s_b g_bj with g_bj = -grad W_bj, and friction mu_b V_b V_j (v_j - v_b) lap W (Akinci et al. 2012), of the fluid and its
// images in the walls. Pressure that is solved for has its reaction in boundary_impulse.comp. A particle writes where its id says, so
// nothing depends on the order of the sort. Twin: engine/reference/boundary_force.cpp.
#define CELL_START_BINDING 1
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "include/sph_kernel.glsl"
#include "shared/particle_state.h"
#include "shared/reaction.h"

layout(constant_id = 4) const bool SOLVED_PRESSURE = false;

layout(push_constant, scalar) uniform Push { ReactionPush push; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 5) uniform textureBuffer velocity_texels;
layout(set = 0, binding = 6, scalar) readonly buffer Interaction { vec4 interaction[]; }; // of shared/sph_params.h
layout(set = 0, binding = 7) uniform textureBuffer interaction_texels;
layout(set = 0, binding = 8, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 9, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 10, scalar) buffer Reactions { Reaction reactions[]; }; // by id

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
    vec3 v[TILE]; // as the present image has it
    float viscous_term[TILE];
    vec3 push_force[TILE];
    vec3 friction[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = min(tile.first + k, tile.last);
        v[k] = load_candidate(velocity, i).xyz;
        viscous_term[k] = load_candidate(interaction, i).z;
        push_force[k] = vec3(0.0);
        friction[k] = vec3(0.0);
    }
    vec3 signs = vec3(1.0);
    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        vec3 flips = signs * image_signs(image);
        signs = image_signs(image);
        vec3 image_push[TILE];
        vec3 image_friction[TILE];
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            v[k] *= flips;
            image_push[k] = vec3(0.0);
            image_friction[k] = vec3(0.0);
        }
        Walk walk = begin_walk(x);
        FOR_EACH_CANDIDATE(range, walk) {
            vec3 xj = load_candidate(position, range.x).xyz;
            vec3 vj = load_candidate(velocity, range.x).xyz;
            vec2 interaction_j = load_candidate(interaction, range.x).xy;
            float volume_j = is_boundary(attributes[range.x]) ? 0.0 : interaction_j.y;
            float pressure_term_j = SOLVED_PRESSURE ? 0.0 : interaction_j.x;
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj;
                float r2 = dot(offset, offset);
                vec2 shape = force_shapes(r2, size);
                image_push[k] += (has_direction(r2, size) ? pressure_term_j * shape.x : 0.0) * offset;
                image_friction[k] += volume_j * viscous_term[k] * shape.y * (vj - v[k]);
            }
        }
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            push_force[k] += signs * image_push[k];
            friction[k] += signs * image_friction[k];
        }
    }

    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = tile.first + k;
        if (i > tile.last || !is_boundary(attributes[i])) {
            continue;
        }
        uint slot = id[i] - push.first_id;
        reactions[slot].pressure += params.dt * own[k].w * push_force[k];
        reactions[slot].friction += params.dt * friction[k];
    }
}
