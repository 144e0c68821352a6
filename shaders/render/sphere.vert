// Particles as spheres: each pulls its particle and the quad that covers the sphere on screen (sphere_quad.comp).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "include/splat.glsl"

layout(binding = 0) uniform textureBuffer spheres; // of sphere_look.comp
layout(binding = 1) uniform textureBuffer quads;
layout(binding = 2, scalar) readonly buffer List { uint list[]; }; // of those who are to be drawn
layout(binding = 3) uniform textureBuffer looks;
layout(binding = 4, scalar) readonly buffer Ids { uint id[]; }; // where there are puffs
layout(push_constant, scalar) uniform Push { SplatPush push; };

layout(location = 0) flat out vec3 out_center; // view space
layout(location = 1) flat out uint out_particle;
layout(location = 2) flat out float out_radius;
layout(location = 3) flat out uint out_puff; // of sand in the air: its id, and 1; else 0

void main()
{
    uint particle = list[uint(gl_VertexIndex) / VERTICES_PER_QUAD];
    vec4 sphere = texelFetch(spheres, int(particle));
    vec4 quad = texelFetch(quads, 2 * int(particle));
    float depth = texelFetch(quads, 2 * int(particle) + 1).x;
    gl_Position = quad_vertex(quad, depth, uint(gl_VertexIndex) % VERTICES_PER_QUAD);
    out_center = (push.camera.view * vec4(sphere.xyz, 1.0)).xyz;
    out_particle = particle;
    out_radius = sphere.w;
    out_puff = texelFetch(looks, int(particle)).w == GLOSS_PUFF ? id[particle] + 1u : 0u;
}
