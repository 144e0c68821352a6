#version 460
#extension GL_GOOGLE_include_directive : require
// The disc of each solid particle at the surface, and how wet it is (shared/solid_splats.h). Twin: engine/reference/solid_splats.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/render_params.h"
#include "shared/solid_splats.h"

layout(push_constant, scalar) uniform Push { SolidSplatPush push; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform Splats { SolidSplatParams splats; };
layout(set = 0, binding = 2, scalar) readonly buffer CellStart { uint cell_start[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Living { vec4 living[]; };
layout(set = 0, binding = 4) uniform textureBuffer living_texels;
layout(set = 0, binding = 5, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 7, scalar) buffer Kept { KeptOfSolid kept[]; }; // by id
layout(set = 0, binding = 8, scalar) buffer Size { float size[]; }; // of balls
layout(set = 0, binding = 9, scalar) readonly buffer Hosted { HostedSplat hosted[]; };
layout(set = 0, binding = 10, scalar) readonly buffer Cover { uint cover[]; }; // by id: a hosted splat, or NO_COVER
layout(set = 0, binding = 11, scalar) writeonly buffer DiscPosition { vec4 disc_position[]; };
layout(set = 0, binding = 12, scalar) writeonly buffer DiscNormal { vec4 disc_normal[]; };
layout(set = 0, binding = 13, scalar) writeonly buffer DiscColor { vec4 disc_color[]; };
layout(set = 0, binding = 14, scalar) writeonly buffer DiscBend { vec4 disc_bend[]; };

#include "include/solid_field.glsl"

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count) {
        return;
    }
    uint disc = push.first_disc + i;
    disc_position[disc] = vec4(0.0);
    float left = living[i].w;
    if (particle_state(attributes[i]) != STATE_SOLID || left <= 0.0) {
        return;
    }
    vec3 x = living[i].xyz;
    SolidField here = solid_field(x);
    float area = 2.0 * params.spacing * length(here.gradient);
    float exposed = smooth_ramp(EXPOSED_FROM, EXPOSED_FULLY, area);
    float thin = (1.0 - exposed) * (1.0 - smooth_ramp(THIN_FULLY, THIN_FROM, here.filling));
    float dying = smooth_ramp(DYING_FROM, 1.0, 1.0 - left);
    size[i] = max(size[i], thin * (1.0 - dying));
    uint slot = id[i];
    if (kept[slot].filling == 0.0) {
        kept[slot].filling = here.filling;
    }
    float part_left = here.filling / kept[slot].filling;
    kept[slot].changed = abs(part_left - 1.0) > UNCHANGED || here.fluid > 0.0 ? 1 : 0;
    if (exposed <= 0.0) {
        return;
    }
    float eroded = smooth_ramp(ERODED_FROM, ERODED_FULLY, 1.0 - part_left);
    float wetness = wetness_after(push.seconds, kept[slot].wetness, here.fluid);
    kept[slot].wetness = wetness;

    float steepness = length(here.gradient);
    vec3 normal = -here.gradient / steepness;
    float depth = depth_below_surface(here.filling);
    float covered = 0.0;
    float backing_radius = 0.0;
    if (cover[slot] != NO_COVER) {
        covered = hosted[cover[slot]].cover;
        backing_radius = hosted[cover[slot]].edge_distance < BACKING_REACH * params.spacing ? BACKING_RADIUS : 0.0;
    }
    float backing = covered * (1.0 - eroded);
    float sunk = PARTICLE_SPLAT_DEPTH + COVERED_DEPTH * covered + BACKING_DEPTH * backing;
    vec3 center = x + (depth - sunk) * params.spacing * normal;
    float radius = mix(PARTICLE_SPLAT_RADIUS, backing_radius, backing) * params.spacing * exposed * (1.0 - dying);
    uint material = particle_material(attributes[i]);
    disc_position[disc] = vec4(center, radius);
    disc_normal[disc] = vec4(normal, DISC_BENT);
    disc_color[disc] = vec4(splats.color[material] * mix(1.0, splats.wet_albedo[material], wetness), 1.0);
    disc_bend[disc] = vec4(0.0, 0.0, 0.0, wetness);
}
