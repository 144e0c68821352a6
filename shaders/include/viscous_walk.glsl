// The viscous forces that act on a tile's particles where viscosity is solved for: those of velocities `direction` (w: mass, 0 of
// boundary particles). Fluid pairs pull along their line, c_ij x x^T (v_j - v_i) with x its unit vector; boundary particles and
// walls drag, c_ij (v_j - v_i). c_ij is symmetric: mu_ij V_i V_j L_ij. Include it after the declarations of `params`, `position`,
// `direction` and `interaction` with their texels, and of `attributes`. Twin: engine/reference/viscosity.cpp.
#ifndef VISCOUS_WALK_GLSL
#define VISCOUS_WALK_GLSL
#include "include/boundary.glsl"
#include "include/image_walk.glsl"
#include "include/mixed_viscosity.glsl"
#include "include/neighbor_bits.glsl"
#include "include/sph_kernel.glsl"

// Of one particle.
struct ViscousForce {
    vec3 force;        // N per m^3 of its volume
    vec3 diagonal;     // its own block, sum_j c_ij x x^T or c_ij, over its volume: minus what it feels of its own velocity
    vec3 off_diagonal; // yz, zx, xy
};

// Whether the blocks are wanted.
#ifndef VISCOUS_BLOCKS
#define VISCOUS_BLOCKS false
#endif

void add_viscous_forces(vec4 own[TILE], Tile tile, out ViscousForce total[TILE])
{
    KernelSize size = kernel_size(params.support_radius);
    float pair_scale = params.pair_viscosity_scale / params.viscosity_scale;
    vec3 p[TILE]; // as the present image has it
    float viscosity[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        p[k] = load_candidate(direction, min(tile.first + k, tile.last)).xyz;
        viscosity[k] = viscosity_of(load_candidate(interaction, min(tile.first + k, tile.last)).xyz);
        total[k] = ViscousForce(vec3(0.0), vec3(0.0), vec3(0.0));
    }
    vec3 signs = vec3(1.0);
    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        vec3 flips = signs * image_signs(image);
        signs = image_signs(image);
        vec3 force[TILE];
        vec3 off_diagonal[TILE];
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            p[k] *= flips;
            force[k] = vec3(0.0);
            off_diagonal[k] = vec3(0.0);
        }
        Walk walk = begin_walk(x);
        FOR_EACH_NEIGHBOR(tile, walk, x, chunks, bits) {
            uint j = chunks.first + findLSB(bits);
            vec4 xj = load_candidate(position, j);
            vec4 pj = load_candidate(direction, j);
            vec3 interaction_j = load_candidate(interaction, j).xyz;
            float viscous_term_j = interaction_j.z;
            float viscosity_j = viscosity_of(interaction_j);
            bool is_fluid = pj.w > 0.0;
            float pair_term_j = is_fluid ? viscous_term_j * pair_scale : 0.0;
            float drag_term_j = is_fluid ? 0.0 : viscous_term_j;
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj.xyz;
                float r2 = dot(offset, offset);
                vec3 relative = pj.xyz - p[k];
                float pair_term = MIXED_VISCOSITY ? pair_term_j * mean_viscosity_ratio(viscosity[k], viscosity_j) : pair_term_j;
                float along = has_direction(r2, size) ? pair_term * pair_viscosity_shape(r2, params.pair_viscosity_taper, size) / r2 : 0.0;
                float drag = drag_term_j * force_shapes(r2, size).y;
                force[k] += along * dot(relative, offset) * offset + drag * relative;
                if (VISCOUS_BLOCKS) {
                    total[k].diagonal += along * offset * offset + drag;
                    off_diagonal[k] += along * offset.yzx * offset.zxy;
                }
            }
        }
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            total[k].force += signs * force[k];
            total[k].off_diagonal += signs.yzx * signs.zxy * off_diagonal[k];
        }
    }
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        Walls walls = nearest_walls(own[k].xyz, params.domain_min, params.domain_max, params.wall_mask);
        vec3 beyond = half_space_viscosity(walls.distance, params.support_radius); // zero beyond the support
        float drag = params.wall_viscosity * params.viscosity_scale * (beyond.x + beyond.y + beyond.z);
        total[k].force -= drag * signs * p[k];
        if (VISCOUS_BLOCKS) { // the matrix itself knows no lid
            total[k].force += params.wall_viscosity * params.viscosity_scale * lid_share(walls, beyond);
        }
        total[k].diagonal += drag;
    }
}

#endif
