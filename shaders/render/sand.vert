// The sheet over columns of sand: two triangles a texel of the map from above.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "include/splat.glsl"
#include "shared/sand_surface.h"
#include "shared/visibility.h"

layout(binding = 0, scalar) uniform View { VisibilityParams view; };
layout(binding = 1) uniform textureBuffer corners;
layout(push_constant, scalar) uniform Push { SplatPush push; };

#include "include/sand_sheet.glsl"

layout(location = 0) out vec4 out_at;            // xy: on the map, texels; z: thickness, spacings; w: how much of a sheet it is
layout(location = 1) flat out uint out_triangle;

void main()
{
    uint quad = uint(gl_VertexIndex) / VERTICES_PER_QUAD;
    uint vertex = uint(gl_VertexIndex) % VERTICES_PER_QUAD;
    uvec2 here = quad_corner(quad, corner_of_vertex(vertex));
    vec4 its = texelFetch(corners, int(corner_index(here)));
    float there = 1.0; // a quad is there as far as all of its corners are: none hangs down a cliff
    float thickest = 0.0;
    for (uint k = 0u; k < 4u; ++k) {
        vec4 each = texelFetch(corners, int(corner_index(quad_corner(quad, k))));
        there = min(there, each.w);
        thickest = max(thickest, each.x);
    }
    vec3 point = (push.camera.view * vec4(place_over_map(vec2(here), its.x), 1.0)).xyz;
    SplatCamera camera = push.camera;
    float w = camera.orthographic != 0u ? 1.0 : -point.z;
    float depth = camera.depth_map.x * w + camera.depth_map.y * (camera.orthographic != 0u ? -point.z : 1.0);
    vec4 clip = vec4((point.xy - camera.plane_offset * w) / camera.plane_scale, depth, w);
    gl_Position = there > 0.0 && thickest > SHEET_FROM * view.spacing ? clip : NO_QUAD;
    out_at = vec4(vec2(here), its.x / view.spacing, there);
    out_triangle = 2u * quad + vertex / 3u;
}
