// Visibility of the sheet of sand: its triangle's index, grain by grain where it is thin.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/render_params.h"
#include "shared/sand_surface.h"
#include "shared/solid_splats.h"

layout(location = 0) in vec4 in_at;
layout(location = 1) flat in uint in_triangle;

layout(location = 0) out uint out_surface;

void main()
{
    uvec2 grain = uvec2(in_at.xy * GRAINS_A_SPACING);
    float covered = in_at.w * smooth_ramp(SHEET_FROM, SHEET_FULLY, in_at.z);
    if (grain_share(grain.x, grain.y, 0u) >= covered) {
        discard;
    }
    out_surface = (SURFACE_SAND << SURFACE_SHIFT) | in_triangle;
}
