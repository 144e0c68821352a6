#version 460
#extension GL_GOOGLE_include_directive : require
// The plane that fits the columns around each best, and how far they are off it (shared/sand_surface.h). Twin:
// engine/reference/sand_surface.cpp.
#include "include/invocation.glsl"
#include "shared/sand_surface.h"
#include "shared/sph_params.h"
#include "shared/visibility.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform View { VisibilityParams view; };
layout(set = 0, binding = 2) uniform textureBuffer column; // texels are faster than a buffer on software devices
// x: height over the texel's middle, m; yz: slope along the map's axes; w: mean square of how far columns are off, spacings.
layout(set = 0, binding = 3, scalar) writeonly buffer Plane { vec4 plane[]; };

#include "include/periodic.glsl"

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
    float base = texelFetch(column, int(i)).x;
    const float widest = float((SHEET_REACH + 1) * (SHEET_REACH + 1));
    float sum = 0.0; // of weights, and with these, of places, their squares, heights in spacings, ...
    vec2 way = vec2(0.0);
    vec3 ways = vec3(0.0); // xx, xy, yy
    float height = 0.0;
    float heights = 0.0;
    vec2 rise = vec2(0.0);
    for (int y = -SHEET_REACH; y <= SHEET_REACH; ++y) {
        int row = inside(texel.y + y, size.y, across) * size.x;
        for (int x = -SHEET_REACH; x <= SHEET_REACH; ++x) {
            vec4 its = texelFetch(column, row + inside(texel.x + x, size.x, along));
            float near = max(1.0 - float(x * x + y * y) / widest, 0.0);
            float weight = its.y * near * near;
            vec2 at = vec2(x, y);
            float h = (its.x - base) / view.spacing;
            sum += weight;
            way += weight * at;
            ways += weight * vec3(at.x * at.x, at.x * at.y, at.y * at.y);
            height += weight * h;
            heights += weight * h * h;
            rise += weight * h * at;
        }
    }
    if (sum <= 0.0) {
        plane[i] = vec4(base, 0.0, 0.0, 0.0);
        return;
    }
    // About the weighted mean.
    vec2 mean = way / sum;
    float mean_height = height / sum;
    vec3 c = ways / sum - vec3(mean.x * mean.x, mean.x * mean.y, mean.y * mean.y) + vec3(SHEET_ROUNDING, 0.0, SHEET_ROUNDING);
    vec2 r = rise / sum - mean * mean_height;
    vec2 slope = vec2(r.x * c.z - r.y * c.y, r.y * c.x - r.x * c.y) / (c.x * c.z - c.y * c.y);
    float off = max(heights / sum - mean_height * mean_height - dot(slope, r), 0.0);
    plane[i] = vec4(base + (mean_height - dot(slope, mean)) * view.spacing, slope * view.spacing / view.texel, off);
}
