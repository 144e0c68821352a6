#version 460
#extension GL_GOOGLE_include_directive : require
// The corners of the sheet over columns of sand (shared/sand_surface.h). Twin: engine/reference/sand_surface.cpp.
#include "include/invocation.glsl"
#include "shared/sand_surface.h"
#include "shared/sph_params.h"
#include "shared/visibility.h"

layout(push_constant, scalar) uniform Push { SandPush push; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform View { VisibilityParams view; };
layout(set = 0, binding = 2) uniform textureBuffer column;
layout(set = 0, binding = 3) uniform textureBuffer tint;
layout(set = 0, binding = 4) uniform textureBuffer plane;
// x: height, m above the floor; yz: slope along the map's axes; w: how much of a sheet is there, 0 to 1, kept.
layout(set = 0, binding = 5, scalar) buffer Corner { vec4 corner[]; };
layout(set = 0, binding = 6, scalar) buffer CornerTint { vec4 corner_tint[]; }; // kept where there is no sand

#include "include/periodic.glsl"

void main()
{
    uint i = invocation_index();
    ivec2 size = ivec2(view.width, view.height);
    ivec2 corners = size + 1;
    if (i >= uint(corners.x * corners.y)) {
        return;
    }
    ivec2 here = ivec2(int(i) % corners.x, int(i) / corners.x);
    bool along = is_periodic_along(view.right);
    bool across = is_periodic_along(view.up);
    const float widest = float((SHEET_REACH + 1) * (SHEET_REACH + 1));
    float sum = 0.0;
    float height = 0.0; // of the planes, at the corner
    vec2 slope = vec2(0.0);
    float off = 0.0;
    float sand = 0.0;
    vec3 color = vec3(0.0);
    for (int y = -SHEET_REACH; y < SHEET_REACH; ++y) {
        int row = inside(here.y + y, size.y, across) * size.x;
        for (int x = -SHEET_REACH; x < SHEET_REACH; ++x) {
            int texel = row + inside(here.x + x, size.x, along);
            vec4 its = texelFetch(column, texel);
            vec4 fit = texelFetch(plane, texel);
            vec2 way = vec2(x, y) + 0.5;
            float near = max(1.0 - dot(way, way) / widest, 0.0);
            float share = its.y * near * near;
            float scatter = fit.w + SHEET_NOISE * SHEET_NOISE;
            float weight = share / (scatter * scatter);
            sum += weight;
            height += weight * (fit.x - dot(fit.yz, way) * view.texel);
            slope += weight * fit.yz;
            off += weight * fit.w;
            sand += share * its.z;
            color += share * its.z * texelFetch(tint, texel).rgb;
        }
    }
    float scale = sum > 0.0 ? 1.0 / sum : 0.0;
    slope *= scale;
    off *= scale;
    bool is_sheet = sum > 0.0 && length(slope) <= STEEPEST_SHEET && off <= ROUGHEST_SHEET * ROUGHEST_SHEET;
    float before = corner[i].w;
    float most = push.first != 0u ? 1.0 : push.seconds / SHEET_TIME;
    float presence = before + clamp((is_sheet ? 1.0 : 0.0) - before, -most, most);
    corner[i] = vec4(max(height * scale, 0.0), slope, presence);
    if (sand > 0.0) {
        corner_tint[i] = vec4(color / sand, 1.0);
    }
}
