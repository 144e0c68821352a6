// Surface splats: each pulls its disc and spans the quad that covers the disc on screen.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "include/splat.glsl"

layout(binding = 0, scalar) readonly buffer Positions { vec4 position_radius[]; };
layout(binding = 1, scalar) readonly buffer Normals { vec4 normals[]; };
layout(binding = 2, scalar) readonly buffer Bends { vec4 bends[]; };
layout(binding = 3, scalar) readonly buffer Colors { vec4 colors[]; };
layout(push_constant, scalar) uniform Push { SplatPush push; };

layout(location = 0) flat out vec4 out_disc; // center in view space, radius
layout(location = 1) flat out vec3 out_normal;
layout(location = 2) flat out uint out_index;
layout(location = 3) flat out vec4 out_edge; // of an edged disc: the way to its edge, and how far that is
layout(location = 4) flat out vec3 out_bend; // of a bent one
layout(location = 5) flat out vec3 out_u;    // its first tangent

void main()
{
    uint disc = uint(gl_VertexIndex) / VERTICES_PER_QUAD;
    vec3 center = (push.camera.view * vec4(position_radius[disc].xyz, 1.0)).xyz;
    mat3 to_view = mat3(push.camera.view);
    float radius = position_radius[disc].w;
    float kind = normals[disc].w;
    vec3 way = push.camera.orthographic != 0u ? vec3(0.0, 0.0, -1.0) : center; // of the eye's rays
    bool turned_away = kind != DISC_FLAT && dot(way, to_view * normals[disc].xyz) >= 0.0;

    gl_Position = NO_QUAD;
    out_disc = vec4(center, radius);
    out_normal = out_bend = out_u = vec3(0.0);
    out_edge = vec4(0.0);
    out_index = disc;
    // One round, or none: of a loop, software devices leave out the rounds that none of eight vertices wants; of a branch they
    // run both sides.
    uint rounds = radius > 0.0 && !turned_away ? 1u : 0u;
    for (uint k = 0u; k < rounds; ++k) {
        vec3 world_normal = normalize(normals[disc].xyz);
        vec3 normal = to_view * world_normal;
        float reach = radius * sqrt(max(1.0 - normal.z * normal.z, 0.0));
        vec4 bound = disc_bound(push.camera, center, normal, radius);
        gl_Position = quad_vertex(push.camera, bound, -center.z - reach, uint(gl_VertexIndex) % VERTICES_PER_QUAD);
        vec3 u;
        vec3 v;
        tangent_frame(world_normal, u, v);
        out_normal = normal;
        out_edge = kind == DISC_EDGED ? vec4(to_view * bends[disc].xyz, colors[disc].w) : vec4(0.0);
        out_bend = kind == DISC_BENT ? bends[disc].xyz : vec3(0.0);
        out_u = to_view * u;
    }
}
