#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// One iteration of position based fluids, first half: the density at the present positions, by how much each constraint is
// violated, and what moves of this iteration are to be made of that (shared/pbf.h). The workgroup that is done last adds up the
// violations and decides whether there is such an iteration. Twin: engine/reference/pbf.cpp.
#define CELL_START_BINDING 1
#define NEIGHBOR_BITS_BINDING 13
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "include/sph_kernel.glsl"
#include "shared/particle_state.h"
#include "shared/solve.h"

layout(push_constant, scalar) uniform Push { ResidualPush push; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; }; // when the grid was made
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer Moved { vec4 moved[]; }; // now; w: weight
layout(set = 0, binding = 5) uniform textureBuffer moved_texels;
layout(set = 0, binding = 6, scalar) readonly buffer Velocity { vec4 velocity[]; }; // w: mass
layout(set = 0, binding = 7) uniform textureBuffer velocity_texels;
layout(set = 0, binding = 8, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 9, scalar) writeonly buffer Density { float density[]; };
layout(set = 0, binding = 10, scalar) writeonly buffer Interaction { vec4 interaction[]; }; // x: X gradient_scale, y: V, w: A likewise
layout(set = 0, binding = 11, scalar) coherent buffer Errors { vec2 errors[]; }; // a workgroup: sum over fluid particles, their number
layout(set = 0, binding = 12, scalar) coherent buffer Solves { Solve solves[SOLVES]; };

#define WORKGROUP_SUMS errors
#define ARRIVED solves[push.solve].arrived
#include "include/boundary.glsl"
#include "include/dispatch_sum.glsl"
#include "include/moved_walk.glsl"
#include "include/solve.glsl"

struct Sums {
    float density;          // sum_j s_j W_ij / density_scale
    vec3 gradient;          // sum_j s_j g_ij / gradient_scale
    float gradient_squares; // sum_j g_ij^2 / (m_j gradient_scale^2)
};

void add_neighbors(vec4 own[TILE], Tile tile, out Sums sums[TILE])
{
    KernelSize size = kernel_size(params.support_radius);
    vec4 now[TILE];
    load_moved(tile, now);
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        sums[k] = Sums(0.0, vec3(0.0), 0.0);
    }
    FOR_EACH_IMAGE(image, tile) {
        vec3 x_then[TILE];
        vec3 x[TILE];
        image_positions(tile, own, image, x_then);
        moved_image_positions(own, now, image, x);
        vec3 image_gradient[TILE];
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            image_gradient[k] = vec3(0.0);
        }
        Walk walk = begin_walk(x_then);
        FOR_EACH_NEIGHBOR(tile, walk, x_then, chunks, bits) {
            uint j = chunks.first + findLSB(bits);
            vec3 xj_then = load_candidate(position, j).xyz;
            vec4 xj = load_candidate(moved, j);
            float inverse_mass = load_candidate(velocity, j).w;
            inverse_mass = inverse_mass > 0.0 ? 1.0 / inverse_mass : 0.0;
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj.xyz;
                float r2 = dot(offset, offset);
                bool neighbors = were_neighbors(x_then[k], xj_then);
                float weight = neighbors ? xj.w : 0.0;
                sums[k].density += weight * density_shape(r2, size);
                float shape = neighbors && has_direction(r2, size) ? force_shapes(r2, size).x : 0.0;
                image_gradient[k] += xj.w * shape * offset;
                sums[k].gradient_squares += inverse_mass * shape * shape * r2;
            }
        }
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            sums[k].gradient += image_signs(image) * image_gradient[k];
        }
    }
}

void end_iteration(float error)
{
    bool met = error <= params.density_error;
    bool ends = push.iteration >= params.max_iterations || (met && push.iteration >= params.least_iterations);
    solves[push.solve].groups = ends ? uvec3(0u) : gl_NumWorkGroups;
    if (ends) {
        note_end(solves[push.solve], push.iteration, error, met);
    }
}

void main()
{
    vec2 error = vec2(0.0);
    if (invocation_index() * TILE < params.moving_count) {
        vec4 own[TILE];
        Tile tile = without_boundary(load_tile(invocation_index(), own));
        Sums sums[TILE];
        add_neighbors(own, tile, sums);
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            uint i = tile.first + k;
            if (i > tile.last) {
                break;
            }
            // Both kinds store in one place: software devices would walk through two.
            bool boundary = is_boundary(attributes[i]);
            float mass = load_candidate(velocity, i).w;
            float rho = mass * params.density_scale * sums[k].density;
            float rest_volume = mass / params.rest_density[particle_material(attributes[i])];
            float excess = rest_volume * params.density_scale * sums[k].density - 1.0;
            float response = (dot(sums[k].gradient, sums[k].gradient) + params.constraint_softness) / mass + sums[k].gradient_squares;
            float per_excess = response > 0.0 ? params.solve_relaxation / (params.gradient_scale * rest_volume * response) : 0.0;
            float wanted = params.clamp_pressure != 0u ? max(excess, 0.0) : excess;
            vec4 its_interaction = vec4(per_excess * wanted, mass / rho, 0.0, per_excess * params.artificial_pressure);
            interaction[i] = boundary ? vec4(0.0) : its_interaction;
            density[i] = boundary ? 0.0 : rho;
            error += boundary ? vec2(0.0) : vec2(max(excess, 0.0), 1.0);
        }
    }
    if (dispatch_sum(error)) {
        end_iteration(error.y > 0.0 ? error.x / error.y : 0.0);
    }
}
