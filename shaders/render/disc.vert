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
    vec3 normal = normalize(mat3(push.camera.view) * normals[disc].xyz);
    float radius = position_radius[disc].w;

    float reach = radius * sqrt(max(1.0 - normal.z * normal.z, 0.0));
    vec3 way = push.camera.orthographic != 0u ? vec3(0.0, 0.0, -1.0) : center; // of the eye's rays
    bool turned_away = normals[disc].w != DISC_FLAT && dot(way, normal) >= 0.0;
    vec4 bound = NOWHERE.xxyy;
    if (radius > 0.0 && !turned_away) {
        bound = disc_bound(push.camera, center, normal, radius);
    }
    gl_Position = quad_vertex(push.camera, bound, -center.z - reach, uint(gl_VertexIndex) % VERTICES_PER_QUAD);
    out_disc = vec4(center, radius);
    out_normal = normal;
    out_index = disc;
    mat3 to_view = mat3(push.camera.view);
    vec3 u;
    vec3 v;
    tangent_frame(normalize(normals[disc].xyz), u, v);
    out_edge = normals[disc].w == DISC_EDGED ? vec4(to_view * bends[disc].xyz, colors[disc].w) : vec4(0.0);
    out_bend = normals[disc].w == DISC_BENT ? bends[disc].xyz : vec3(0.0);
    out_u = to_view * u;
}
