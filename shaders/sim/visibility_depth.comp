#version 460
#extension GL_GOOGLE_include_directive : require
// The depth map of what is seen along a direction: each particle that hides others enters its depth into the texels whose centers
// its disc covers. Twin: engine/reference/visibility.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/sph_params.h"
#include "shared/visibility.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform View { VisibilityParams view; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 4, scalar) buffer Map { uint map[]; };

#include "include/visibility.glsl"

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count || (view.casters >> particle_state(attributes[i]) & 1u) == 0u) {
        return;
    }
    vec3 place = map_place(position[i].xyz);
    uint depth = depth_of(position[i].xyz);
    float radius = CASTER_RADIUS * view.spacing / view.texel;
    ivec2 first = max(ivec2(floor(place.xy - radius)), ivec2(0));
    ivec2 last = min(ivec2(floor(place.xy + radius)), ivec2(view.width, view.height) - 1);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            if (distance(vec2(x, y) + 0.5, place.xy) <= radius) {
                atomicMin(map[y * int(view.width) + x], depth);
            }
        }
    }
}
