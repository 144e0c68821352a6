#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Density and pressure: rho_i = m_i sum_j s_j W_ij over the particles and their images in the walls, s_j their weights
// (Solenthaler & Pajarola 2008; Akinci et al. 2012), then the state equation; and what the forces need of both. Boundary
// particles have neither. Twin: engine/reference/density.cpp.
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
layout(set = 0, binding = 5, scalar) readonly buffer Velocity { vec4 velocity[]; }; // w: mass
layout(set = 0, binding = 6) uniform textureBuffer velocity_texels;
layout(set = 0, binding = 7, scalar) writeonly buffer Density { float density[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer Pressure { float pressure[]; };
layout(set = 0, binding = 9, scalar) writeonly buffer Interaction { vec4 interaction[]; }; // of shared/sph_params.h

#include "include/boundary.glsl"
#include "include/image_walk.glsl"

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
    if (invocation_index() * TILE >= params.particle_count) {
        return;
    }
    vec4 own[TILE];
    Tile tile = without_boundary(load_tile(invocation_index(), own));

    float h = params.support_radius;
    KernelSize size = kernel_size(h);
    float sum[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        sum[k] = 0.0;
    }

    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        Walk walk = begin_walk(x);
        FOR_EACH_CANDIDATE(range, walk) {
            vec4 xj = load_candidate(position, range.x);
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj.xyz;
                sum[k] += xj.w * density_shape(dot(offset, offset), size);
            }
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
        float p = boundary ? 0.0 : state_equation(rho, params.rest_density[material]);
        float d3 = params.spacing * params.spacing * params.spacing;
        float volume = boundary ? own[k].w * d3 : mass / rho;
        float viscosity = boundary ? params.friction[material] : params.viscosity;
        density[i] = boundary ? 0.0 : rho;
        pressure[i] = p;
        interaction[i] = vec4(params.gradient_scale * p * volume * volume, volume, params.viscosity_scale * viscosity * volume, 0.0);
    }
}
