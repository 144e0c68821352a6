// Visibility of surface splats: the disc's index where the eye ray meets its plane inside the rim, at the exact depth.
// Intersecting the plane in each fragment, instead of projecting the ellipse's axes, keeps tilted splats from growing past
// the silhouette.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "include/splat.glsl"

layout(push_constant, scalar) uniform Push { SplatPush push; };

layout(location = 0) flat in vec4 in_disc;
layout(location = 1) flat in vec3 in_normal;
layout(location = 2) flat in uint in_index;
layout(location = 3) flat in vec4 in_edge;
layout(location = 4) flat in vec3 in_bend;
layout(location = 5) flat in vec3 in_u;

layout(location = 0) out uint out_surface;
layout(depth_less) out float gl_FragDepth;

void main()
{
    Ray ray = ray_through(push.camera, ndc_of_sample(push.camera, gl_FragCoord.xy));
    float rho_squared;
    vec3 point = intersect_disc(ray, in_disc.xyz, in_normal, in_disc.w, rho_squared);
    vec3 q = point - in_disc.xyz;
    vec2 at = vec2(dot(q, in_u), dot(q, cross(in_normal, in_u)));
    float off = 0.5 * abs(dot(vec3(at.x * at.x, 2.0 * at.x * at.y, at.y * at.y), in_bend)); // the bent surface's, m
    bool is_there = rho_squared <= 1.0 && dot(q, in_edge.xyz) <= in_edge.w && off <= BENT_OFF * in_disc.w;
    if (!is_there || !in_depth_range(push.camera, point)) { // also an edge-on plane's NaN
        discard;
    }
    out_surface = (SURFACE_DISC << SURFACE_SHIFT) | in_index;
    gl_FragDepth = depth_at(push.camera, -point.z);
}
