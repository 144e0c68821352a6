#version 460
#extension GL_GOOGLE_include_directive : require
// Where solids and colliders are otherwise than they were when this pass ran last: the cells around are marked, for what the
// surface is there is to be found out anew (exposure.comp). What nobody near has changed for is as it was, to the last bit.
#include "include/grid.glsl"
#include "include/invocation.glsl"
#include "shared/exposure.h"
#include "shared/particle_state.h"
#include "shared/sph_params.h"

layout(push_constant, scalar) uniform Push { uint round; }; // that the cells are marked with
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Position { vec4 position[]; }; // w: weight
layout(set = 0, binding = 2, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 4, scalar) buffer Known { vec4 known[]; };       // by id: the same as last time, of who is not there 0
layout(set = 0, binding = 5, scalar) writeonly buffer Marks { uint marks[]; }; // of each cell
layout(set = 0, binding = 6, scalar) writeonly buffer Exposure { vec4 exposure[]; }; // by id

#include "include/periodic.glsl"

const int FARTHEST_WRAP = 16; // domain lengths that the reach is at most

void mark_around(vec4 place)
{
    vec3 reach = vec3(EXPOSURE_SUPPORT * params.spacing);
    ivec3 size = ivec3(params.grid_size);
    bvec3 periodic = periodic_axes();
    reach += mix(vec3(0.0), vec3(params.support_radius), periodic); // where cells and the domain do not end together
    vec3 cell_size = params.support_radius / vec3(CELLS_PER_SUPPORT_X, 1.0, 1.0);
    vec3 most = vec3(FARTHEST_WRAP * size); // places are in the domain, and NaN is somewhere
    ivec3 low = ivec3(floor(clamp((place.xyz - reach - params.domain_min) / cell_size, -most, 2.0 * most)));
    ivec3 high = ivec3(floor(clamp((place.xyz + reach - params.domain_min) / cell_size, -most, 2.0 * most)));
    high = place.w > 0.0 ? high : low - 1; // nobody is there
    for (int z = low.z; z <= high.z; ++z) {
        for (int y = low.y; y <= high.y; ++y) {
            for (int x = low.x; x <= high.x; ++x) {
                ivec3 cell = mix(clamp(ivec3(x, y, z), ivec3(0), size - 1), (ivec3(x, y, z) + FARTHEST_WRAP * size) % size, periodic);
                marks[cell_index(cell, params.grid_size)] = round;
            }
        }
    }
}

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count) {
        return;
    }
    uint state = particle_state(attributes[i]);
    vec4 now = state == STATE_SOLID || state == STATE_COLLIDER ? position[i] : vec4(0.0);
    vec4 before = known[id[i]];
    if (now == before) {
        return;
    }
    known[id[i]] = now;
    if (state != STATE_SOLID) {
        exposure[id[i]] = vec4(0.0);
    }
    mark_around(before);
    mark_around(now);
}
