#version 460
#extension GL_GOOGLE_include_directive : require
// Where the spheres of particles are, how large, of what color and how glossy: found once for each, not for each vertex or sample.
#include "include/invocation.glsl"
#include "shared/colormap.h"
#include "shared/particle_state.h"
#include "shared/render_params.h"

layout(push_constant, scalar) uniform Push { uint count; };
layout(set = 0, binding = 0, scalar) uniform Params { RenderParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Density { float density[]; }; // of dust: what is left of it
layout(set = 0, binding = 4, scalar) readonly buffer Pressure { float pressure[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Id { uint id[]; };              // where params.blend_time > 0
layout(set = 0, binding = 7, scalar) readonly buffer FreedAt { float freed_at[]; };  // likewise: by id, s
layout(set = 0, binding = 8, scalar) readonly buffer Size { float size[]; };         // in radii, where params.sized
layout(set = 0, binding = 9, scalar) writeonly buffer Sphere { vec4 sphere[]; };     // center, radius: 0 of who is not to be seen
layout(set = 0, binding = 10, scalar) writeonly buffer Look { vec4 look[]; };        // linear RGB, GLOSS_* or how wet it is

const vec3 LUMINANCE = vec3(0.2126, 0.7152, 0.0722); // of linear RGB (ITU-R BT.709)

float radius_of(uint i)
{
    uint state = particle_state(attributes[i]);
    if (state == STATE_DEAD) {
        return 0.0;
    }
    if (params.sized != 0u) {
        return params.splat_radius * size[i];
    }
    return state == STATE_DUST ? params.splat_radius * pow(density[i], 1.0 / 3.0) : params.splat_radius;
}

// How much of a solid's color a particle still has.
float solid_share(uint i)
{
    uint state = particle_state(attributes[i]);
    if (state != STATE_FLUID || cause_of(attributes[i]) == CAUSE_NONE || params.blend_time <= 0.0) {
        return state == STATE_SOLID || state == STATE_DUST ? 1.0 : 0.0;
    }
    return 1.0 - smoothstep(0.0, params.blend_time, params.time - freed_at[id[i]]);
}

float in_range(float value) { return (value - params.color_range.x) / (params.color_range.y - params.color_range.x); }

vec3 color_of(uint i)
{
    uint material = min(particle_material(attributes[i]), MAX_MATERIALS - 1u);
    vec3 color = mix(params.material_color[material], params.solid_color[material], solid_share(i));
    if (params.color_mode != COLOR_MATERIAL && is_boundary(attributes[i])) { // it has none of these quantities
        return vec3(dot(color, LUMINANCE));
    }
    switch (params.color_mode) {
    case COLOR_DENSITY:
        return density[i] < params.rest_density[material] ? below_rest_color() : colormap(in_range(density[i]));
    case COLOR_SPEED:
        return colormap(in_range(length(velocity[i].xyz)));
    case COLOR_PRESSURE:
        return colormap(in_range(pressure[i]));
    }
    return color;
}

void main()
{
    uint i = invocation_index();
    if (i >= count) {
        return;
    }
    bool is_puff = params.sized != 0u && is_flying_sand(attributes[i]);
    float gloss = is_puff                                        ? GLOSS_PUFF
                  : params.color_mode != COLOR_MATERIAL                    ? GLOSS_MATTE
                  : particle_state(attributes[i]) == STATE_FLUID ? GLOSS_WET
                                                                 : GLOSS_DRY;
    sphere[i] = vec4(position[i].xyz, radius_of(i));
    look[i] = vec4(color_of(i), gloss);
}
