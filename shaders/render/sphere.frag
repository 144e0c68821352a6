// Visibility of spheres: the particle's index where the eye ray hits its sphere, at the exact depth.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "include/splat.glsl"
#include "shared/sand_surface.h"

layout(push_constant, scalar) uniform Push { SplatPush push; };

layout(location = 0) flat in vec3 in_center;
layout(location = 1) flat in uint in_particle;
layout(location = 2) flat in float in_radius;
layout(location = 3) flat in uint in_puff;

layout(location = 0) out uint out_surface;
layout(depth_less) out float gl_FragDepth;

// Of a puff of sand some specks are there, the more the nearer to its middle. They are the same from frame to frame.
bool is_speck(vec2 off)
{
    uvec2 speck = uvec2(ivec2(floor(off * SPECKS_A_RADIUS)) + 256);
    float inside = 1.0 - dot(off, off);
    return grain_share(speck.x, speck.y, in_puff) < PUFF_COVERAGE * inside * inside;
}

void main()
{
    Ray ray = ray_through(push.camera, ndc_of_sample(push.camera, gl_FragCoord.xy));
    float miss;
    vec3 point = intersect_sphere(push.camera, ray, in_center, in_radius, miss);
    bool is_seen = in_puff == 0u || is_speck((point.xy - in_center.xy) / in_radius);
    if (miss > 0.0 || !is_seen || !in_depth_range(push.camera, point)) {
        discard;
    }
    out_surface = (SURFACE_SPHERE << SURFACE_SHIFT) | in_particle;
    gl_FragDepth = depth_at(push.camera, -point.z);
}
