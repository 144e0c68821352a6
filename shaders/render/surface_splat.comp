#version 460
#extension GL_GOOGLE_include_directive : require
// Surface splats go with the three solid particles that each belongs to (shared/solid_splats.h). Twin:
// engine/reference/solid_splats.cpp.
#include "include/invocation.glsl"
#include "shared/render_params.h"
#include "shared/solid_splats.h"

layout(push_constant, scalar) uniform Push { SolidSplatPush push; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer CellStart { uint cell_start[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Living { vec4 living[]; }; // w: 1 - p of solids, else at most 0
layout(set = 0, binding = 3) uniform textureBuffer living_texels;
layout(set = 0, binding = 4, scalar) buffer Hosted { HostedSplat hosted[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Place { uint place[]; }; // by id
layout(set = 0, binding = 6, scalar) readonly buffer Kept { KeptOfSolid kept[]; }; // by id, of the frame before
layout(set = 0, binding = 7, scalar) writeonly buffer DiscPosition { vec4 disc_position[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer DiscNormal { vec4 disc_normal[]; };
layout(set = 0, binding = 9, scalar) writeonly buffer DiscColor { vec4 disc_color[]; };
layout(set = 0, binding = 10, scalar) writeonly buffer DiscBend { vec4 disc_bend[]; };

#include "include/solid_field.glsl"

void main()
{
    uint i = invocation_index();
    if (i >= push.hosted) {
        return;
    }
    HostedSplat splat = hosted[i];
    vec4 a = living[place[splat.host.x]];
    vec4 b = living[place[splat.host.y]];
    vec4 c = living[place[splat.host.z]];
    float mean_progress = dot(splat.weight, 1.0 - max(vec3(a.w, b.w, c.w), 0.0));
    float worst_progress = 1.0 - max(min(min(a.w, b.w), c.w), 0.0);
    vec3 first = b.xyz - a.xyz;
    vec3 second = c.xyz - a.xyz;
    mat3 frame = mat3(first, second, cross(first, second) / params.spacing);
    vec3 normal = normalize(frame * splat.normal);
    float recession = RECESSION * params.spacing * mean_progress;
    vec3 center = a.xyz + frame * splat.offset - recession * normal;

    // Most do not change: where nothing has near the hosts, there is nothing to look up.
    uint has_changed = kept[splat.host.x].changed | kept[splat.host.y].changed | kept[splat.host.z].changed;
    SolidField here = SolidField(splat.filling, vec3(0.0), 0.0);
    if (splat.filling == 0.0 || worst_progress > 0.0 || splat.wetness > 0.0 || has_changed != 0u) {
        here = solid_field(center);
    }
    float start = splat.filling == 0.0 ? max(here.filling, 1e-6) : splat.filling;
    float bare = 1.0 - smooth_ramp(BARE_FULLY, BARE_FROM, here.filling / start);
    float sinking = max(smooth_ramp(SINKING_FROM, SINKING_UNTIL, worst_progress), bare);
    vec3 up = -here.gradient / max(length(here.gradient), 1e-6);
    float facing = smooth_ramp(0.0, EXPOSED_FROM, -2.0 * params.spacing * dot(here.gradient, normal));
    float turning = sinking * facing;
    float rise = depth_below_surface(here.filling) - PARTICLE_SPLAT_DEPTH - SINKING_DEPTH;
    center += turning * clamp(rise, -1.0, 1.0) * params.spacing * up;
    normal = normalize(mix(normal, up, turning));

    float radius = splat.radius * (1.0 - smooth_ramp(SHRINKING_FROM, 1.0, worst_progress)) *
                   (1.0 - bare * (1.0 - facing)); // nothing to sink to
    float stretch = max(max(length(first), length(second)), length(second - first));
    if (worst_progress >= 1.0 || stretch > MOST_STRETCH * splat.span) {
        hosted[i].radius = radius = 0.0;
    }
    float wetness = wetness_after(push.seconds, splat.wetness, here.fluid);
    hosted[i].filling = start;
    hosted[i].wetness = wetness;
    hosted[i].cover = radius > 0.0 ? 1.0 - sinking : 0.0;

    uint disc = push.first_hosted + i;
    disc_position[disc] = vec4(center, radius);
    disc_normal[disc] = vec4(normal, DISC_EDGED);
    disc_color[disc] = vec4(splat.color * mix(1.0, splat.wet_albedo, wetness), splat.edge_distance - recession);
    disc_bend[disc] = vec4(frame * splat.edge, wetness);
}
