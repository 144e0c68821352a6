#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Heat flows between neighbors for one explicit step (shared/heat.h; Cleary & Monaghan 1999), along walls between images, too.
// Temperatures are all those of before the step, so enthalpy may be written over. Twin: engine/reference/heat.cpp.
#define CELL_START_BINDING 1
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "include/sph_kernel.glsl"
#include "shared/heat.h"
#include "shared/two_float.h"

layout(push_constant, scalar) uniform Push { float dt; }; // s
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3) uniform textureBuffer position_texels;
layout(set = 0, binding = 4, scalar) readonly buffer Thermal { vec4 thermal[]; }; // of shared/heat.h
layout(set = 0, binding = 5) uniform textureBuffer thermal_texels;
layout(set = 0, binding = 6, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 7, scalar) buffer Enthalpy { vec2 enthalpy[]; }; // by id, two-floats
layout(set = 0, binding = 8, scalar) readonly buffer WarmCells { uint warm_cells[]; };

#include "include/image_walk.glsl"
#include "include/warm_cells.glsl"

// Whether heat may flow to one of the tile's particles. Their neighbors in mirrors lie as near themselves; across periodic borders,
// and of those who walk one by one, nobody knows.
bool may_get_heat(Tile tile, vec4 own[TILE])
{
    bool unknown = tile.is_wide || params.periodic_mask != 0u;
    ivec3 low = ivec3(params.grid_size);
    ivec3 high = ivec3(-1);
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        ivec3 cell = cell_within(own[k].xyz);
        low = min(low, cell);
        high = max(high, cell);
    }
    ivec3 reach = ivec3(CELLS_PER_SUPPORT_X, 1, 1);
    low = max(low - reach, ivec3(0));
    high = unknown ? low - 1 : min(high + reach, ivec3(params.grid_size) - 1);
    uint found = 0u;
    for (int z = low.z; z <= high.z; ++z) {
        for (int y = low.y; y <= high.y; ++y) {
            uint row = warm_row(ivec2(y, z));
            for (int word = low.x / 32; word <= high.x / 32; ++word) {
                uint from = uint(max(low.x - 32 * word, 0));
                uint to = uint(min(high.x - 32 * word, 31));
                found |= warm_cells[row + uint(word)] & (~0u << from) & (~0u >> (31u - to));
            }
        }
    }
    return unknown || found != 0u;
}

void main()
{
    if (invocation_index() * TILE >= params.pool_count) {
        return;
    }
    vec4 own[TILE];
    Tile tile = load_tile_of(0u, params.pool_count, invocation_index(), own);
    vec4 its[TILE];
    float sum[TILE]; // sum_j V_j k_ij (T_j - T_i) (-W' / r) / gradient_scale
    bool any_changes = false;
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        its[k] = load_candidate(thermal, min(tile.first + k, tile.last));
        sum[k] = 0.0;
        any_changes = any_changes || its[k].w > 0.0;
    }
    tile.images = any_changes && may_get_heat(tile, own) ? tile.images : 0u;

    KernelSize size = kernel_size(params.support_radius);
    float nearest = NEAREST_CONDUCTION * params.spacing;
    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        Walk walk = begin_walk(x);
        FOR_EACH_CANDIDATE(range, walk) {
            vec3 xj = load_candidate(position, range.x).xyz;
            vec3 thermal_j = load_candidate(thermal, range.x).xyz;
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = x[k] - xj;
                float r2 = max(dot(offset, offset), nearest * nearest);
                float flow = thermal_j.z * pair_conductivity(its[k].y, thermal_j.y) * (thermal_j.x - its[k].x);
                sum[k] += flow * force_shapes(r2, size).x;
            }
        }
    }

    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = tile.first + k;
        if (i > tile.last) {
            break;
        }
        if (its[k].w > 0.0) {
            uint slot = id[i];
            enthalpy[slot] = two_float_add(enthalpy[slot], dt * its[k].w * params.gradient_scale * sum[k]);
        }
    }
}
