// Surface splats: each pulls its disc and spans the quad that covers the disc on screen.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "include/splat.glsl"

layout(binding = 0, scalar) readonly buffer Positions { vec4 position_radius[]; };
layout(binding = 1, scalar) readonly buffer Normals { vec4 normals[]; };
layout(push_constant, scalar) uniform Push { SplatPush push; };

layout(location = 0) flat out vec4 out_disc; // center in view space, radius
layout(location = 1) flat out vec3 out_normal;
layout(location = 2) flat out uint out_index;

void main()
{
    uint disc = uint(gl_VertexIndex) / VERTICES_PER_QUAD;
    vec3 center = (push.camera.view * vec4(position_radius[disc].xyz, 1.0)).xyz;
    vec3 normal = normalize(mat3(push.camera.view) * normals[disc].xyz);
    float radius = position_radius[disc].w;

    float reach = radius * sqrt(max(1.0 - normal.z * normal.z, 0.0));
    vec4 bound = disc_bound(push.camera, center, normal, radius);
    gl_Position = quad_vertex(push.camera, bound, -center.z - reach, uint(gl_VertexIndex) % VERTICES_PER_QUAD);
    out_disc = vec4(center, radius);
    out_normal = normal;
    out_index = disc;
}
