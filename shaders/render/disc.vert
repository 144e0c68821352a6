// Surface splats: each pulls its disc and the quad that covers the disc on screen (disc_quad.comp).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "include/splat.glsl"

layout(binding = 0) uniform textureBuffer positions; // w: radius
layout(binding = 1) uniform textureBuffer normals;   // w: DISC_*
layout(binding = 2) uniform textureBuffer bends;
layout(binding = 3) uniform textureBuffer colors;    // w, of an edged one: how far its edge is
layout(binding = 4) uniform textureBuffer quads;     // of disc_quad.comp
layout(binding = 5, scalar) readonly buffer List { uint list[]; }; // of those who are to be drawn
layout(push_constant, scalar) uniform Push { SplatPush push; };

layout(location = 0) flat out vec4 out_disc; // center in view space, radius
layout(location = 1) flat out vec3 out_normal;
layout(location = 2) flat out uint out_index;
layout(location = 3) flat out vec4 out_edge; // of an edged disc: the way to its edge, and how far that is
layout(location = 4) flat out vec3 out_bend; // of a bent one
layout(location = 5) flat out vec3 out_u;    // its first tangent

void main()
{
    uint disc = list[uint(gl_VertexIndex) / VERTICES_PER_QUAD];
    vec4 quad = texelFetch(quads, 2 * int(disc));
    float depth = texelFetch(quads, 2 * int(disc) + 1).x;
    gl_Position = quad_vertex(quad, depth, uint(gl_VertexIndex) % VERTICES_PER_QUAD);

    vec4 position_radius = texelFetch(positions, int(disc));
    vec4 normal_kind = texelFetch(normals, int(disc));
    vec3 bend = texelFetch(bends, int(disc)).xyz;
    float kind = normal_kind.w;
    mat3 to_view = mat3(push.camera.view);
    vec3 normal = normalize(normal_kind.xyz);
    vec3 u;
    vec3 v;
    tangent_frame(normal, u, v);
    out_disc = vec4((push.camera.view * vec4(position_radius.xyz, 1.0)).xyz, position_radius.w);
    out_normal = to_view * normal;
    out_index = disc;
    out_edge = kind == DISC_EDGED ? vec4(to_view * bend, texelFetch(colors, int(disc)).w) : vec4(0.0);
    out_bend = kind == DISC_BENT ? bend : vec3(0.0);
    out_u = to_view * u;
}
