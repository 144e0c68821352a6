#version 460
#extension GL_GOOGLE_include_directive : require
// The quads that cover discs on a camera's screen, and which of them there are: found once for each, not for each vertex.
#include "include/invocation.glsl"
#include "include/splat.glsl"

layout(push_constant, scalar) uniform Push { QuadPush push; };
layout(set = 0, binding = 0, scalar) readonly buffer Positions { vec4 position_radius[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Normals { vec4 normals[]; }; // w: DISC_*
layout(set = 0, binding = 2, scalar) writeonly buffer Quads { vec4 quads[]; };    // two for each: see quad_on_screen
layout(set = 0, binding = 3, scalar) writeonly buffer Flags { uint flags[]; };    // 1 where there is one

void main()
{
    uint i = invocation_index();
    if (i >= push.count) {
        return;
    }
    vec3 center = (push.camera.view * vec4(position_radius[i].xyz, 1.0)).xyz;
    float radius = position_radius[i].w;
    vec3 normal = mat3(push.camera.view) * normalize(normals[i].xyz);
    vec3 way = push.camera.orthographic != 0u ? vec3(0.0, 0.0, -1.0) : center; // of the eye's rays
    bool turned_away = normals[i].w != DISC_FLAT && dot(way, normal) >= 0.0;
    float reach = radius * sqrt(max(1.0 - normal.z * normal.z, 0.0));
    vec4 quad;
    bool is_there = quad_on_screen(push.camera, disc_bound(push.camera, center, normal, radius), quad);
    quads[2u * i] = quad;
    quads[2u * i + 1u] = vec4(quad_depth(push.camera, -center.z - reach));
    flags[i] = radius > 0.0 && !turned_away && is_there ? 1u : 0u;
}
