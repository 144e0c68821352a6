#version 460
#extension GL_GOOGLE_include_directive : require
// The exposed surface of solid particles: its normal and area (shared/exposure.h). Walls are mirrors here too: what stands at
// one is not exposed there. Twin: engine/reference/exposure.cpp.
#include "include/candidate.glsl"
#include "include/grid.glsl"
#include "include/invocation.glsl"
#include "shared/exposure.h"
#include "shared/particle_state.h"

layout(push_constant, scalar) uniform Push { ExposurePush push; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer CellStart { uint cell_start[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; }; // w: weight
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer Exposure { vec4 exposure[]; }; // by id: n, A in m^2
layout(set = 0, binding = 7, scalar) readonly buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 8) uniform textureBuffer velocity_texels;
layout(set = 0, binding = 9, scalar) readonly buffer Marks { uint marks[]; }; // of each cell (surface_change.comp)

#include "include/periodic.glsl"

// The sums of solid_around over the particles j of one of the tables of cells, or, of the moving ones, over those of them that are solid.
vec4 solid_in_table(vec3 x, float support_radius, int table, bool moving)
{
    ivec3 size = ivec3(params.grid_size);
    ivec3 low = cell_coordinates(x - support_radius, params.domain_min, params.support_radius, params.grid_size);
    ivec3 high = cell_coordinates(x + support_radius, params.domain_min, params.support_radius, params.grid_size);
    low = clamp(low, ivec3(0), size - 1);
    high = clamp(high, ivec3(0), size - 1);
    vec4 sum = vec4(0.0);
    for (int z = low.z; z <= high.z; ++z) {
        for (int y = low.y; y <= high.y; ++y) {
            int row = table + cell_index(ivec3(0, y, z), params.grid_size);
            uint end = cell_start[row + high.x + 1];
            for (uint j = cell_start[row + low.x]; j < end; ++j) {
                vec4 neighbor = load_candidate(position, j);
                vec3 offset = x - neighbor.xyz;
                float u = max(1.0 - length(offset) / support_radius, 0.0);
                float counts = moving && load_candidate(velocity, j).w > 0.0 ? 0.0 : neighbor.w; // dust has no weight either
                float weight = counts * u * u * u;
                sum += weight * vec4(offset, u * (5.0 - 4.0 * u));
            }
        }
    }
    return vec4(sum.xyz / support_radius, sum.w);
}

// Of x or an image of it: the sums over solids and colliders nearer than the support radius, whose rows of cells may be any
// number (the cells are made for the fluid's kernel). xyz leads away from what is solid, w is how full of it the place is.
vec4 solid_around(vec3 x, float support_radius)
{
    int still = int(params.grid_size.x * params.grid_size.y * params.grid_size.z); // where their cell starts begin
    vec4 sum = solid_in_table(x, support_radius, still, false);
    return push.any_loose != 0u ? sum + solid_in_table(x, support_radius, 0, true) : sum;
}

void main()
{
    uint i = push.first + invocation_index();
    if (invocation_index() >= push.count || particle_state(attributes[i]) != STATE_SOLID) {
        return;
    }
    uint cell = cell_of(position[i].xyz, params.domain_min, params.support_radius, params.grid_size);
    if (push.round != 0u && marks[cell] != push.round) {
        return;
    }
    // The images beyond the borders within reach: -1 is that at the lower one, 1 that at the upper one.
    float support_radius = EXPOSURE_SUPPORT * params.spacing;
    vec3 x = position[i].xyz;
    vec3 extent = params.domain_max - params.domain_min;
    uvec3 borders = uvec3(params.wall_mask | params.periodic_mask);
    bvec3 at_low = lessThan(x - params.domain_min, vec3(support_radius));
    bvec3 at_high = lessThan(params.domain_max - x, vec3(support_radius));
    ivec3 first = -ivec3(at_low) * ivec3(notEqual(borders & uvec3(1u, 4u, 16u), uvec3(0u)));
    ivec3 last = ivec3(at_high) * ivec3(notEqual(borders & uvec3(2u, 8u, 32u), uvec3(0u)));
    vec4 sum = vec4(0.0);
    ivec3 side;
    for (side.z = first.z; side.z <= last.z; ++side.z) {
        for (side.y = first.y; side.y <= last.y; ++side.y) {
            for (side.x = first.x; side.x <= last.x; ++side.x) {
                bvec3 reflects = mix(notEqual(side, ivec3(0)), bvec3(false), periodic_axes());
                vec3 border = mix(params.domain_min, params.domain_max, greaterThan(side, ivec3(0)));
                vec3 image = mix(x - vec3(side) * extent, 2.0 * border - x, reflects);
                sum += vec4(mix(vec3(1.0), vec3(-1.0), reflects), 1.0) * solid_around(image, support_radius);
            }
        }
    }
    float size = length(sum.xyz);
    float thinness = max(1.0 - push.filling_scale * sum.w / THIN_FILLING, 0.0);
    float share = max(push.area_scale * size, push.faces * thinness); // of the face of a lattice cell
    vec3 normal = size > 0.0 ? sum.xyz / size : vec3(0.0);
    float area = share * position[i].w * params.lattice_volume / params.spacing;
    exposure[id[i]] = share < LEAST_EXPOSURE ? vec4(0.0) : vec4(normal, area);
}
