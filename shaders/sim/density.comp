#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Density and pressure: rho_i = m_i sum_j s_j W_ij over the particles and their images in the walls, s_j their weights
// (Solenthaler & Pajarola 2008; Akinci et al. 2012), then the state equation; and what the forces need of both. Where pressure
// is solved for, there is no state equation but the diagonal of the solve (Bender & Koschier 2015, their factor alpha): with
// g_ij = -grad W_ij, gradient_scale / (|sum_j s_j g_ij|^2 / m_i + sum_j |g_ij|^2 / m_j), the latter over fluid: without the
// scale it would be too small for a float where particles are a tenth of a millimeter fine. Boundary particles have none of these. Twins: engine/reference/density.cpp, dfsph.cpp.
#define CELL_START_BINDING 1
#define FINDS_NEIGHBORS
#define NEIGHBOR_BITS_BINDING 10
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "include/sph_kernel.glsl"
#include "shared/particle_state.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Velocity { vec4 velocity[]; }; // w: mass
layout(set = 0, binding = 6) uniform textureBuffer velocity_texels;
layout(set = 0, binding = 7, scalar) writeonly buffer Density { float density[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer Pressure { float pressure[]; };
layout(set = 0, binding = 9, scalar) writeonly buffer Interaction { vec4 interaction[]; }; // of shared/sph_params.h

layout(constant_id = 4) const bool SOLVED_PRESSURE = false;

#include "include/boundary.glsl"
#include "include/image_walk.glsl"
#include "include/neighbor_bits.glsl"

float state_equation(float rho, float rho0)
{
    float c2 = params.speed_of_sound * params.speed_of_sound;
    float p = params.background_pressure;
    if (params.state_equation == STATE_EQUATION_TAIT) {
        p += c2 * rho0 / params.gamma * (pow(rho / rho0, params.gamma) - 1.0);
    } else {
        p += c2 * (rho - rho0);
    }
    return params.clamp_pressure != 0u ? max(p, 0.0) : p;
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
    float sum[TILE];
    vec3 gradient[TILE];         // sum_j s_j g_ij / gradient_scale
    float gradient_squares[TILE]; // sum_j g_ij^2 / (m_j gradient_scale^2)
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        sum[k] = 0.0;
        gradient[k] = vec3(0.0);
        gradient_squares[k] = 0.0;
    }

    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        vec3 image_gradient[TILE];
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            image_gradient[k] = vec3(0.0);
        }
        Walk walk = begin_walk(x);
        FOR_EACH_NEIGHBOR(tile, walk, x, chunks, bits) {
            uint j = chunks.first + findLSB(bits);
            vec4 xj = load_candidate(position, j);
            float inverse_mass = SOLVED_PRESSURE ? load_candidate(velocity, j).w : 0.0;
            inverse_mass = inverse_mass > 0.0 ? 1.0 / inverse_mass : 0.0;
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj.xyz;
                float r2 = dot(offset, offset);
                sum[k] += xj.w * density_shape(r2, size);
                if (SOLVED_PRESSURE) {
                    float shape = has_direction(r2, size) ? force_shapes(r2, size).x : 0.0;
                    image_gradient[k] += xj.w * shape * offset;
                    gradient_squares[k] += inverse_mass * shape * shape * r2;
                }
            }
        }
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            gradient[k] += image_signs(image) * image_gradient[k];
        }
    }

    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = tile.first + k;
        if (i > tile.last) {
            break;
        }
        // Both kinds store in one place: software devices would walk through two.
        bool boundary = is_boundary(attributes[i]);
        uint material = particle_material(attributes[i]);
        float mass = load_candidate(velocity, i).w;
        float rho = mass * params.density_scale * sum[k];
        float volume = boundary ? own[k].w * params.lattice_volume : mass / rho;
        float viscosity = boundary ? params.friction[material] : params.viscosity[material];
        vec4 its_interaction = vec4(0.0, volume, params.viscosity_scale * viscosity * volume, 0.0);
        if (SOLVED_PRESSURE) {
            float response = dot(gradient[k], gradient[k]) / mass + gradient_squares[k];
            its_interaction.w = !boundary && response > 0.0 ? 1.0 / (params.gradient_scale * response) : 0.0;
        } else {
            float p = boundary ? 0.0 : state_equation(rho, params.rest_density[material]);
            pressure[i] = p;
            its_interaction.x = params.gradient_scale * p * volume * volume;
        }
        density[i] = boundary ? 0.0 : rho;
        interaction[i] = its_interaction;
    }
}
