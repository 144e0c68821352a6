#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Loose sand at rest is to be solid where there is room: where it does not fill space more than once together with the solids
// and, as if they all were, with those at rest around it of smaller id. Nobody is solid yet: land_apply.comp makes them so. Twin:
// engine/reference/wind.cpp.
#define CELL_START_BINDING 1
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/sph_params.h"
#include "shared/wind.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) uniform Wind { WindParams wind; };
layout(set = 0, binding = 3, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 6) uniform textureBuffer position_texels;
layout(set = 0, binding = 7, scalar) readonly buffer Rests { uint rests[]; };   // by id
layout(set = 0, binding = 8, scalar) writeonly buffer Lands { uint lands[]; }; // by id

#include "include/solid_around.glsl"

bool rests_loose(uint i)
{
    uint cause = cause_of(attributes[i]);
    return particle_state(attributes[i]) == STATE_DUST && cause == CAUSE_SLIDE && rests[id[i]] != 0u;
}

// The part of space around here that loose particles at rest with smaller ids fill.
float filled_before(vec3 here, uint its_id)
{
    KernelSize size = kernel_size(params.support_radius);
    vec4 own[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        own[k] = vec4(k == 0u ? here : NOWHERE, 0.0);
    }
    float sum = 0.0;
    Tile tile = tile_at(here);
    FOR_EACH_IMAGE(image, tile) {
        vec3 x[TILE];
        image_positions(tile, own, image, x);
        Walk walk = begin_walk(x, params.domain_min, params.support_radius, params.grid_size); // of the moving ones alone
        FOR_EACH_CANDIDATE(range, walk) {
            vec3 offset = x[0] - position[range.x].xyz;
            float filling = density_shape(dot(offset, offset), size);
            sum += filling > 0.0 && id[range.x] < its_id && rests_loose(range.x) ? filling : 0.0;
        }
    }
    return params.lattice_volume * params.density_scale * sum;
}

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count || !rests_loose(i)) {
        return;
    }
    vec3 x = position[i].xyz;
    float filling = solid_around(x).x + filled_before(x, id[i]) + wind.own_filling;
    lands[id[i]] = filling <= 1.0 ? 1u : 0u;
}
