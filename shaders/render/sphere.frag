// Visibility of spheres: the particle's index where the eye ray hits its sphere, at the exact depth.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "include/splat.glsl"

layout(push_constant, scalar) uniform Push { SplatPush push; };

layout(location = 0) flat in vec3 in_center;
layout(location = 1) flat in uint in_particle;
layout(location = 2) flat in float in_radius;

layout(location = 0) out uint out_surface;
layout(depth_less) out float gl_FragDepth;

void main()
{
    Ray ray = ray_through(push.camera, ndc_of_sample(push.camera, gl_FragCoord.xy));
    float miss;
    vec3 point = intersect_sphere(push.camera, ray, in_center, in_radius, miss);
    if (miss > 0.0 || !in_depth_range(push.camera, point)) {
        discard;
    }
    out_surface = (SURFACE_SPHERE << SURFACE_SHIFT) | in_particle;
    gl_FragDepth = depth_at(push.camera, -point.z);
}
