#version 460
#extension GL_GOOGLE_include_directive : require
// The plane that fits the tops of the columns around each texel best, by least squares (include/ground.glsl). Where nothing
// stands it is the floor. Twin: engine/reference/wind.cpp.
#include "include/invocation.glsl"
#include "shared/sph_params.h"
#include "shared/visibility.h"
#include "shared/wind.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform View { VisibilityParams view; }; // from above
layout(set = 0, binding = 2, scalar) readonly buffer Map { uint map[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer GroundBuffer { vec4 ground[]; }; // height, slope along the map's axes, top

#include "include/periodic.glsl"

// m above the floor. A particle at rest on the floor is half a spacing above it, and a spacing above what it lies on.
float top_of(ivec2 texel)
{
    uint depth = map[texel.y * int(view.width) + texel.x];
    float fallen = float(depth) / view.depth_scale;
    return depth == NOTHING_SEEN ? -0.5 * view.spacing : float(DEPTH_STEPS) / view.depth_scale - fallen;
}

void main()
{
    uint i = invocation_index();
    ivec2 size = ivec2(view.width, view.height);
    if (i >= view.width * view.height) {
        return;
    }
    ivec2 texel = ivec2(int(i) % size.x, int(i) / size.x);
    bool along = is_periodic_along(view.right);
    bool across = is_periodic_along(view.up);
    float sum = 0.0;
    vec2 rise = vec2(0.0);
    float squares = 0.0;
    for (int y = -GROUND_REACH; y <= GROUND_REACH; ++y) {
        for (int x = -GROUND_REACH; x <= GROUND_REACH; ++x) {
            float top = top_of(ivec2(inside(texel.x + x, size.x, along), inside(texel.y + y, size.y, across)));
            sum += top;
            rise += top * vec2(x, y);
            squares += float(x * x);
        }
    }
    float texels = float((2 * GROUND_REACH + 1) * (2 * GROUND_REACH + 1));
    ground[i] = vec4(sum / texels, rise / (squares * view.texel), top_of(texel));
}
