// The picture of the floor and the background, alone in most pixels: a pass of its own, as what it leaves to resolve.frag costs
// software devices, which run all sides of all branches, several times as much. Its depth tells them apart.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "include/shading.glsl"
#include "include/splat.glsl"
#include "include/picture.glsl"

layout(location = 0) out vec4 out_color;

void main()
{
    bool only_floor = samples_of(gathered_samples(), SURFACE_NONE << SURFACE_SHIFT) == ALL_SAMPLES;
    // Shaded where its first sample is, as all surfaces are.
    out_color = vec4(floor_color(ray_of_sample(0)), 1.0);
    gl_FragDepth = only_floor ? 1.0 : 0.0; // 0 is not drawn
}
