#version 460
#extension GL_GOOGLE_include_directive : require
// The top of a column of sand that is too steep is to slide to the lowest column beside it, for its distance, and says so there.
// Two measures of steep: the plane through the columns around, and the step to a single one. The place on a column is for the one
// of smallest id; nobody moves yet: slide_apply.comp moves them. Twin: engine/reference/wind.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/sph_params.h"
#include "shared/visibility.h"
#include "shared/wind.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform Wind { WindParams wind; };
layout(set = 0, binding = 2, scalar) uniform View { VisibilityParams view; };
layout(set = 0, binding = 3, scalar) readonly buffer GroundBuffer { vec4 ground[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 7, scalar) readonly buffer TopId { uint top_id[]; }; // of each texel
layout(set = 0, binding = 8, scalar) writeonly buffer Way { uint way[]; };     // likewise
layout(set = 0, binding = 9, scalar) buffer Claim { uint claim[]; };           // likewise: the smallest id that is to come there

#include "include/ground.glsl"

void main()
{
    uint i = params.moving_count + invocation_index();
    if (i >= params.pool_count || particle_state(attributes[i]) != STATE_SOLID) {
        return;
    }
    WindMaterial sand = wind.of[particle_material(attributes[i])];
    ivec2 here = texel_at(position[i].xyz);
    if (sand.erodes == 0u || top_id[index_of(here)] != id[i]) {
        return;
    }
    Ground its = ground_at(here);
    bool on_steep_ground = length(its.slope) > sand.steepest;
    uint its_way = WAY_NONE;
    float drop = 0.0;
    float steepest = 0.0; // drop over distance, in spacings
    uint first = id[i] * 2654435769u >> 29u; // of equal ways: no side is preferred
    for (uint turn = 0u; turn < 8u; ++turn) {
        uint k = (first + turn) % 8u;
        k += k >= WAY_NONE ? 1u : 0u;
        vec2 along = vec2(k % 3u, k / 3u) - 1.0;
        float step = (its.top - ground_at(neighbor_of(here, k)).top) / params.spacing;
        float slope = step / length(along);
        bool downhill = dot(its.slope, along.x * view.right + along.y * view.up) < 0.0;
        bool slides = slope > STEEPEST_STEP || (on_steep_ground && downhill && step > LEAST_STEP);
        if (slides && slope > steepest + EQUAL_STEP) {
            steepest = slope;
            drop = step;
            its_way = k;
        }
    }
    if (its_way == WAY_NONE) {
        return;
    }
    bool falls = drop > HIGHEST_SLIDE;
    way[index_of(here)] = its_way + (falls ? WAY_FALLS : 0u);
    if (!falls) {
        atomicMin(claim[index_of(neighbor_of(here, its_way))], id[i]);
    }
}
