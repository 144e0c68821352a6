#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Where the surface is: gradients and normals of shared/capillarity.h, step 1. Twin: engine/reference/capillarity.cpp.
#define CELL_START_BINDING 1
#define NEIGHBOR_BITS_BINDING 9
#include "include/candidate.glsl"
#include "include/capillarity.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "include/sph_kernel.glsl"
#include "shared/particle_state.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer Velocity { vec4 velocity[]; }; // w: mass, 0 of boundary particles
layout(set = 0, binding = 5) uniform textureBuffer velocity_texels;
layout(set = 0, binding = 6, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer Gradient { vec4 gradient[]; }; // n_i, 1/m; w: sigma_i, 0 of boundary particles
layout(set = 0, binding = 8, scalar) writeonly buffer Normal { vec4 normal[]; };    // what curvature is taken of, likewise

layout(constant_id = 12) const bool COLLIDERS = false;

#include "include/boundary.glsl"
#include "include/image_walk.glsl"
#include "include/neighbor_bits.glsl"

// A solid as the fluid near it sees it.
struct Solid {
    vec3 normal; // unit, into the fluid
    float closeness;
    float cosine; // of the contact angle
};

// Turns the gradient into the solid's plane, and the normal to the contact angle.
void meet(Solid solid, bool mirrors, inout vec3 its_gradient, inout vec3 its_normal)
{
    float off_plane = dot(its_gradient, solid.normal);
    vec3 along = its_gradient - off_plane * solid.normal;
    // Beyond a mirror fluid goes on; a collider is the same on both sides of the line.
    vec3 turned = along / (mirrors ? 1.0 : 1.0 - params.share_beyond_solid);
    float steepness = length(along);
    vec3 inward = steepness > 0.0 ? along / steepness : vec3(0.0);
    float sine = sqrt(max(1.0 - solid.cosine * solid.cosine, 0.0));
    vec3 at_contact = sine * inward - solid.cosine * solid.normal;
    its_gradient = mix(its_gradient, turned, solid.closeness);
    float length_of_normal = length(its_normal);
    vec3 direction = length_of_normal > 0.0 ? its_normal / length_of_normal : vec3(0.0);
    vec3 mixed = mix(direction, at_contact, solid.closeness);
    its_normal = length(its_gradient) / max(length(mixed), 1e-30) * mixed;
}

Solid nearest_wall(vec3 x)
{
    Walls walls = nearest_walls(x, params.domain_min, params.domain_max, params.wall_mask);
    float nearest = min(walls.distance.x, min(walls.distance.y, walls.distance.z));
    vec3 normal = walls.distance.x == nearest ? vec3(walls.normal.x, 0.0, 0.0)
                : walls.distance.y == nearest ? vec3(0.0, walls.normal.y, 0.0)
                                              : vec3(0.0, 0.0, walls.normal.z);
    return Solid(normal, clamp(CONTACT_REACH - nearest / params.spacing, 0.0, 1.0), params.wall_contact_cosine);
}

void main()
{
    if (invocation_index() * TILE >= params.moving_count) {
        return;
    }
    vec4 own[TILE];
    Tile tile = without_boundary(load_tile(invocation_index(), own));

    KernelSize size = kernel_size(params.support_radius);
    vec3 all_matter[TILE];
    vec3 solids[TILE];
    vec2 cosines[TILE]; // sum of the colliders' shares times their cosines, sum of their shares
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        all_matter[k] = solids[k] = vec3(0.0);
        cosines[k] = vec2(0.0);
    }
    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        vec3 signs = image_signs(image);
        vec3 image_matter[TILE];
        vec3 image_solids[TILE];
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            image_matter[k] = image_solids[k] = vec3(0.0);
        }
        Walk walk = begin_walk(x);
        FOR_EACH_NEIGHBOR(tile, walk, x, chunks, bits) {
            uint j = chunks.first + findLSB(bits);
            vec4 xj = load_candidate(position, j); // w: weight
            bool is_solid = COLLIDERS && load_candidate(velocity, j).w <= 0.0;
            float solid_weight = is_solid ? xj.w : 0.0;
            float cosine = COLLIDERS ? params.contact_cosine[particle_material(attributes[j])] : 0.0;
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj.xyz;
                float r2 = dot(offset, offset);
                float shape = has_direction(r2, size) ? force_shapes(r2, size).x : 0.0;
                image_matter[k] -= xj.w * shape * offset;
                if (COLLIDERS) {
                    float share = solid_weight * shape;
                    image_solids[k] -= share * offset;
                    cosines[k] += share * vec2(cosine, 1.0);
                }
            }
        }
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            all_matter[k] += signs * image_matter[k];
            solids[k] += signs * image_solids[k];
        }
    }

    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = tile.first + k;
        if (i > tile.last) {
            break;
        }
        float sigma = is_boundary(attributes[i]) ? 0.0 : params.tension[particle_material(attributes[i])];
        float scale = params.lattice_volume * params.gradient_scale;
        vec3 its_gradient = scale * all_matter[k];
        vec3 its_normal = its_gradient;
        if (COLLIDERS && cosines[k].y > 0.0) {
            vec3 toward = scale * solids[k];
            float steepness = length(toward);
            Solid solid = Solid(-toward / max(steepness, 1e-30), min(steepness * params.support_radius, 1.0),
                                cosines[k].x / cosines[k].y);
            meet(solid, false, its_gradient, its_normal);
        }
        meet(nearest_wall(own[k].xyz), true, its_gradient, its_normal);
        bool feels = sigma > 0.0;
        gradient[i] = feels ? vec4(its_gradient, sigma) : vec4(0.0);
        normal[i] = feels ? vec4(its_normal, sigma) : vec4(0.0);
    }
}
