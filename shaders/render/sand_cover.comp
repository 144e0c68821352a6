#version 460
#extension GL_GOOGLE_include_directive : require
// Sand below its sheet counts as gone for the splats of solids, and sand in the air is a puff (shared/sand_surface.h). Twin:
// engine/reference/sand_surface.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/sand_surface.h"
#include "shared/solid_splats.h"
#include "shared/visibility.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform Splats { SolidSplatParams splats; };
layout(set = 0, binding = 2, scalar) uniform View { VisibilityParams view; };
layout(set = 0, binding = 3, scalar) readonly buffer Corner { vec4 corner[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 5, scalar) buffer Living { vec4 living[]; }; // w: what is left of solids
layout(set = 0, binding = 6, scalar) buffer Size { float size[]; };    // of balls and puffs, in radii of a particle

#include "include/sand_sheet.glsl"

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count || splats.is_sand[particle_material(attributes[i])] == 0u) {
        return;
    }
    bool is_solid = particle_state(attributes[i]) == STATE_SOLID;
    bool flies = is_flying_sand(attributes[i]);
    if (!is_solid && !flies) {
        return;
    }
    vec3 at = place_on_map(living[i].xyz);
    vec2 texel = clamp(floor(at.xy), vec2(0.0), vec2(view.width, view.height) - 1.0);
    vec2 f = clamp(at.xy - texel, 0.0, 1.0);
    uint quad = uint(texel.y) * view.width + uint(texel.x);
    vec4 a = corner[corner_index(quad_corner(quad, 0u))];
    vec4 b = corner[corner_index(quad_corner(quad, 1u))];
    vec4 c = corner[corner_index(quad_corner(quad, 2u))];
    vec4 d = corner[corner_index(quad_corner(quad, 3u))];
    float above = (at.z - bilinear(a, b, c, d, f).x) / view.spacing; // the sheet
    if (is_solid) {
        // A quad is there as far as all of its corners are.
        living[i].w *= above < -COVERED_BELOW ? 1.0 : 1.0 - min(min(a.w, b.w), min(c.w, d.w));
    } else {
        size[i] = PUFF_RADIUS * smooth_ramp(0.0, PUFF_HEIGHT, above);
    }
}
