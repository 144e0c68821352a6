#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Accelerations: pressure, viscosity and the paper's surface tension, of the particles and their images in the walls; gravity;
// wall friction and contact. Pair forces are symmetric, so momentum is conserved: F_ij = -(p_i V_i^2 s_j + p_j V_j^2 s_i)
// grad W + mu_ij V_i V_j (v_j - v_i) lap W, with V = m / rho and the weights s (Mueller et al. 2003 as corrected; Solenthaler &
// Pajarola 2008; Akinci et al. 2012). Boundary particles do not move: what they feel is left out. Twin: engine/reference/forces.cpp.
#define CELL_START_BINDING 1
#define NEIGHBOR_BITS_BINDING 10
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "include/sph_kernel.glsl"
#include "shared/particle_state.h"

layout(constant_id = 2) const bool TENSION = false;
layout(constant_id = 4) const bool SOLVED_PRESSURE = false; // then pressure and contact come later in the step
layout(constant_id = 6) const bool SOLVED_VISCOSITY = false; // and so do viscosity and friction

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 5) uniform textureBuffer velocity_texels;
layout(set = 0, binding = 6, scalar) readonly buffer Interaction { vec4 interaction[]; }; // of shared/sph_params.h
layout(set = 0, binding = 7) uniform textureBuffer interaction_texels;
layout(set = 0, binding = 8, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 9, scalar) writeonly buffer Acceleration { vec4 acceleration[]; };

#include "include/boundary.glsl"
#include "include/image_walk.glsl"
#include "include/mixed_viscosity.glsl"
#include "include/neighbor_bits.glsl"

// Friction against walls, and the contact spring.
vec3 wall_acceleration(vec3 x, vec3 v, float rho)
{
    Walls walls = nearest_walls(x, params.domain_min, params.domain_max, params.wall_mask);
    vec3 spring = params.contact_stiffness * (params.contact_distance - walls.distance);
    vec3 push = max(spring - params.contact_damping * v * walls.normal, vec3(0.0)) * walls.normal;
    vec3 viscosity = half_space_viscosity(walls.distance, params.support_radius); // zero beyond the support
    vec3 friction = (viscosity.x + viscosity.y + viscosity.z) * v - lid_share(walls, viscosity);
    friction *= SOLVED_VISCOSITY ? 0.0 : params.wall_viscosity / rho * params.viscosity_scale;
    bvec3 in_contact = lessThan(walls.distance, vec3(SOLVED_PRESSURE ? -NO_WALL : params.contact_distance));
    return mix(vec3(0.0), push, in_contact) - friction;
}

// Mueller et al. 2003: -sigma lap(c) n / |n| where the surface is, a look. n points into the fluid.
vec3 tension_acceleration(vec3 n, float laplacian, float rho)
{
    float length_n = length(n);
    if (length_n * params.support_radius <= params.tension_threshold) {
        return vec3(0.0);
    }
    return -params.surface_tension / rho * laplacian / length_n * n;
}

void main()
{
    if (invocation_index() * TILE >= params.moving_count) {
        return;
    }
    vec4 own[TILE];
    Tile tile = without_boundary(load_tile(invocation_index(), own));

    float h = params.support_radius;
    KernelSize size = kernel_size(h);
    vec3 v[TILE]; // as the present image has it
    float mass[TILE];
    float pressure_term[TILE]; // p V^2 gradient_scale
    float volume[TILE];        // V
    float viscosity[TILE];     // mu, where fluids differ in it
    vec3 force[TILE];
    vec3 color_gradient[TILE];
    float color_laplacian[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = min(tile.first + k, tile.last);
        vec4 its_velocity = load_candidate(velocity, i);
        v[k] = its_velocity.xyz;
        mass[k] = its_velocity.w;
        vec4 its_interaction = load_candidate(interaction, i);
        pressure_term[k] = its_interaction.x;
        volume[k] = its_interaction.y;
        viscosity[k] = viscosity_of(its_interaction.xyz);
        force[k] = vec3(0.0);
        color_gradient[k] = vec3(0.0);
        color_laplacian[k] = 0.0;
    }

    vec3 signs = vec3(1.0);
    FOR_EACH_IMAGE(image, tile) {
        // The tile, not the candidates, is reflected at the walls of the image: position, velocity, and the force back.
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        vec3 flips = signs * image_signs(image);
        signs = image_signs(image);
        vec3 image_force[TILE];
        vec3 image_gradient[TILE];
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            v[k] *= flips;
            image_force[k] = vec3(0.0);
            image_gradient[k] = vec3(0.0);
        }
        Walk walk = begin_walk(x);
        FOR_EACH_NEIGHBOR(tile, walk, x, chunks, bits) {
            uint j = chunks.first + findLSB(bits);
            vec4 xj = load_candidate(position, j);
            vec4 velocity_j = load_candidate(velocity, j);
            vec3 vj = velocity_j.xyz;
            vec3 interaction_j = load_candidate(interaction, j).xyz;
            float pressure_term_j = interaction_j.x;
            float volume_j = interaction_j.y;
            float viscous_term_j = SOLVED_VISCOSITY ? 0.0 : interaction_j.z;
            float viscosity_j = viscosity_of(interaction_j);
            bool mixes = MIXED_VISCOSITY && velocity_j.w > 0.0; // against colliders it is theirs alone
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj.xyz;
                float r2 = dot(offset, offset);
                vec2 shape = force_shapes(r2, size);
                float viscous_term = mixes ? viscous_term_j * mean_viscosity_ratio(viscosity[k], viscosity_j) : viscous_term_j;
                float pressure_terms = pressure_term[k] * xj.w + pressure_term_j;
                float pressure = !SOLVED_PRESSURE && has_direction(r2, size) ? pressure_terms * shape.x : 0.0;
                image_force[k] += pressure * offset + volume[k] * viscous_term * shape.y * (vj - v[k]);
                if (TENSION) {
                    vec2 color = color_shapes(r2, size);
                    image_gradient[k] -= volume_j * color.x * offset;
                    color_laplacian[k] += volume_j * color.y;
                }
            }
        }
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            force[k] += signs * image_force[k];
            color_gradient[k] += signs * image_gradient[k];
        }
    }

    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = tile.first + k;
        if (i > tile.last) {
            break;
        }
        float rho = mass[k] / volume[k];
        vec3 a = params.gravity + force[k] / mass[k];
        a += wall_acceleration(own[k].xyz, signs * v[k], rho);
        if (TENSION) {
            a += tension_acceleration(params.color_gradient_scale * color_gradient[k],
                                      params.color_laplacian_scale * color_laplacian[k], rho);
        }
        acceleration[i] = vec4(is_boundary(attributes[i]) ? vec3(0.0) : a, 0.0);
    }
}
