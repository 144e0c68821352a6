#version 460
#extension GL_GOOGLE_include_directive : require
// The quads that cover spheres on a camera's screen, and which of them there are: found once for each, not for each vertex.
#include "include/invocation.glsl"
#include "include/splat.glsl"

layout(push_constant, scalar) uniform Push { QuadPush push; };
layout(set = 0, binding = 0, scalar) readonly buffer Spheres { vec4 spheres[]; }; // of sphere_look.comp
layout(set = 0, binding = 1, scalar) readonly buffer Looks { vec4 looks[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Quads { vec4 quads[]; };    // two for each: see quad_on_screen
layout(set = 0, binding = 3, scalar) writeonly buffer Flags { uint flags[]; };    // 1 where there is one

void main()
{
    uint i = invocation_index();
    if (i >= push.count) {
        return;
    }
    vec3 center = (push.camera.view * vec4(spheres[i].xyz, 1.0)).xyz;
    float radius = spheres[i].w;
    vec4 quad;
    bool is_there = quad_on_screen(push.camera, sphere_bound(push.camera, center, radius), quad);
    quads[2u * i] = quad;
    quads[2u * i + 1u] = vec4(quad_depth(push.camera, -center.z - radius));
    bool is_seen = looks[i].w != GLOSS_PUFF || push.puffs != 0u;
    flags[i] = radius > 0.0 && is_seen && is_there ? 1u : 0u;
}
