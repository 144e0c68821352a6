#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// One iteration of a solve, second half: what the velocities lead to, drho/dt or the density at the end of the step, how far
// that is from what is wanted, and the pressures of the next iterate (Jacobi, relaxed; Bender & Koschier 2015), with momentum
// (Nesterov 1983), which takes the iterations from the square of the fluid's depth in particles to the depth. Fluid resists
// being compressed, never being torn: pressures stay positive. The first iterate is the warm start, where there is anything to
// resist. In steps shorter than params.correction_time only a share of what is too dense already is taken away. The workgroup that is done last adds up the errors and decides whether there is a next iteration. Twin:
// engine/reference/dfsph.cpp.
#define CELL_START_BINDING 1
#define NEIGHBOR_BITS_BINDING 11
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "include/sph_kernel.glsl"
#include "shared/particle_state.h"
#include "shared/solve.h"

layout(push_constant, scalar) uniform Push { ResidualPush push; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer Velocity { vec4 velocity[]; }; // of the present iterate; w: mass
layout(set = 0, binding = 5) uniform textureBuffer velocity_texels;
layout(set = 0, binding = 6, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 7, scalar) buffer Interaction { vec4 interaction[]; };
layout(set = 0, binding = 13) uniform textureBuffer interaction_texels;
layout(set = 0, binding = 8, scalar) buffer WarmStart { vec2 warm_start[]; };    // by SOLVE_*: X gradient_scale, times dt for density
layout(set = 0, binding = 12, scalar) buffer JacobiStep { float jacobi_step[]; }; // the last iterate without momentum, as interaction's x
layout(set = 0, binding = 9, scalar) coherent buffer Errors { vec2 errors[]; }; // a workgroup: sum over fluid particles, their number
layout(set = 0, binding = 10, scalar) coherent buffer Solves { Solve solves[SOLVES]; };

#define WORKGROUP_SUMS errors
#define ARRIVED solves[push.solve].arrived
#include "include/boundary.glsl"
#include "include/dispatch_sum.glsl"
#include "include/image_walk.glsl"
#include "include/neighbor_bits.glsl"
#include "include/solve.glsl"

// sum_j s_j (v_j - v_i) . g_ij of each particle of the tile, over gradient_scale: the rate of its number density.
void number_density_rates(vec4 own[TILE], Tile tile, out float rate[TILE])
{
    KernelSize size = kernel_size(params.support_radius);
    vec3 v[TILE]; // as the present image has it
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        v[k] = load_candidate(velocity, min(tile.first + k, tile.last)).xyz;
        rate[k] = 0.0;
    }
    vec3 signs = vec3(1.0);
    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        vec3 flips = signs * image_signs(image);
        signs = image_signs(image);
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            v[k] *= flips;
        }
        Walk walk = begin_walk(x);
        FOR_EACH_NEIGHBOR(tile, walk, x, chunks, bits) {
            uint j = chunks.first + findLSB(bits);
            vec4 xj = load_candidate(position, j);
            vec3 vj = load_candidate(velocity, j).xyz;
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj.xyz;
                float r2 = dot(offset, offset);
                float shape = has_direction(r2, size) ? force_shapes(r2, size).x : 0.0;
                rate[k] += xj.w * shape * dot(vj - v[k], offset);
            }
        }
    }
}

void end_iteration(float error)
{
    bool met = error <= (push.solve == SOLVE_DENSITY ? params.density_error : params.divergence_error);
    bool last = push.iteration >= params.max_iterations;
    bool ends = last || (met && push.iteration > 0u); // the warm start is only a guess
    bool risen = push.iteration == 0u || error > solves[push.solve].error;
    solves[push.solve].groups = ends ? uvec3(0u) : gl_NumWorkGroups;
    solves[push.solve].unrisen = risen ? 0u : solves[push.solve].unrisen + 1u;
    solves[push.solve].error = error;
    if (ends) {
        note_end(solves[push.solve], push.iteration, error, met);
    }
}

void main()
{
    float share = density_share(params.dt, params.correction_time);
    vec2 error = vec2(0.0);
    if (invocation_index() * TILE < params.moving_count) {
        vec4 own[TILE];
        Tile tile = without_boundary(load_tile(invocation_index(), own));
        float rate[TILE];
        number_density_rates(own, tile, rate);
        float momentum = push.iteration == 0u ? 0.0 : solve_momentum(solves[push.solve].unrisen);
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            uint i = tile.first + k;
            if (i > tile.last || is_boundary(attributes[i])) {
                if (i <= tile.last) {
                    warm_start[i][push.solve] = 0.0; // of the dead who may be born again
                }
                continue;
            }
            vec4 its_interaction = load_candidate(interaction, i);
            float rest_volume = load_candidate(velocity, i).w / params.rest_density[particle_material(attributes[i])];
            float compression = rest_volume / its_interaction.y;                           // rho / rho0
            float change = params.dt * rest_volume * params.gradient_scale * rate[k];      // of it, in this step
            float dense = compression > 1.0 ? share * (compression - 1.0) : compression - 1.0;
            float excess = push.solve == SOLVE_DENSITY ? dense + change : (compression > DIVERGENCE_FILL ? change : 0.0);

            // The impulses that the velocities have in them: those of a solve that ends here are what has acted.
            float unit = push.solve == SOLVE_DENSITY ? params.dt : 1.0;
            float acted = its_interaction.x;
            float before = jacobi_step[i];
            if (push.iteration == 0u) {
                acted = excess > 0.0 ? WARM_START * warm_start[i][push.solve] / unit : 0.0;
                before = acted;
            } else {
                warm_start[i][push.solve] = acted * unit;
            }
            float response = params.solve_relaxation * its_interaction.w / (params.dt * rest_volume);
            float next = max(acted + response * excess, 0.0);
            jacobi_step[i] = next;
            interaction[i].x = max(next + momentum * (next - before), 0.0);
            error += vec2(max(excess, 0.0), 1.0);
        }
    }
    error.x /= push.solve == SOLVE_DENSITY ? share : 1.0; // as if all were to be taken away at this rate
    if (dispatch_sum(error)) {
        end_iteration(error.y > 0.0 ? error.x / error.y : 0.0);
    }
}
