#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Those whose birth has come look whether their place is free: no particle is nearer than BIRTH_DISTANCE spacings, and none of
// those who are born now too and have a smaller id. `density` says so: 1 or 0, or -1 while it is not time yet. A pass of its own,
// for births change what it looks at. Twin: engine/reference/emission.cpp.
#define CELL_START_BINDING 1
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "shared/emission.h"
#include "shared/particle_state.h"
#include "shared/sph_params.h"
#include "shared/time_step.h"

layout(push_constant, scalar) uniform Push { float start; }; // s: the time when step.elapsed was 0
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Step { TimeStep step; };
layout(set = 0, binding = 3, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 4, scalar) readonly buffer ReleaseTime { float release_time[]; }; // by id, s
layout(set = 0, binding = 5, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 7) uniform textureBuffer position_texels;
layout(set = 0, binding = 8, scalar) readonly buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 9, scalar) writeonly buffer Density { float density[]; };

#include "include/birth.glsl"
#include "include/image_walk.glsl"

// Whether particle j is in the way of one that is to be born at x.
bool is_in_the_way(vec3 x, uint own_id, uint j, float time)
{
    bool comes_first = is_due(attributes[j], release_time[id[j]], time) && id[j] < own_id;
    vec4 xj = load_candidate(position, j);
    vec3 place = comes_first ? birth_position(xj.xyz, velocity[j].xyz, release_time[id[j]], time) : xj.xyz;
    float reach = BIRTH_DISTANCE * params.spacing;
    return (xj.w > 0.0 || comes_first) && dot(x - place, x - place) < reach * reach; // the dead and dust have no weight
}

bool is_free(vec3 x, uint i, float time)
{
    bool found = any(lessThan(x, params.domain_min)) || any(greaterThan(x, params.domain_max));
    Walls borders = nearest_borders(x);
    vec3 walking[TILE]; // a walk is that of a tile
    [[unroll]] for (uint k = 1u; k < TILE; ++k) {
        walking[k] = NOWHERE;
    }
    for (uint image = 0u; image < 8u; ++image) { // across periodic borders
        bool shifted = all(lessThanEqual(uvec3(image_axes(image)), uvec3(periodic_axes())));
        walking[0] = shifted && has_image(image, borders) ? image_position(x, image, borders) : NOWHERE;
        Walk walk = begin_walk(walking);
        FOR_EACH_CANDIDATE(range, walk) {
            found = found || (range.x != i && is_in_the_way(walking[0], id[i], range.x, time));
        }
    }
    return !found;
}

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count || (attributes[i] & FLAG_DUE) == 0u) {
        return;
    }
    float time = start + step.elapsed;
    if (!is_due(attributes[i], release_time[id[i]], time)) {
        density[i] = -1.0;
        return;
    }
    vec3 x = birth_position(position[i].xyz, velocity[i].xyz, release_time[id[i]], time);
    density[i] = is_free(x, i, time) ? 1.0 : 0.0;
}
