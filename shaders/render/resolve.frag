// From visible surfaces to the picture: looks up what each sample shows, intersects it again for the exact point and
// normal, colors and lights it, and averages the samples of a pixel in linear light.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "include/shading.glsl"
#include "include/splat.glsl"
#include "shared/colormap.h"
#include "shared/particle_state.h"
#include "shared/sand_surface.h"
#include "shared/visibility.h"

layout(binding = 0, scalar) readonly buffer Params { RenderParams params; };
layout(binding = 1) uniform usampler2D visibility;
layout(binding = 2) uniform sampler2D shadow_map;
layout(binding = 3, scalar) readonly buffer Positions { vec4 position[]; };
layout(binding = 4, scalar) readonly buffer Velocities { vec4 velocity[]; };
layout(binding = 5, scalar) readonly buffer Densities { float density[]; };
layout(binding = 6, scalar) readonly buffer Pressures { float pressure[]; };
layout(binding = 7, scalar) readonly buffer Attributes { uint attributes[]; };
layout(binding = 8, scalar) readonly buffer DiscPositions { vec4 disc_position_radius[]; };
layout(binding = 9, scalar) readonly buffer DiscNormals { vec4 disc_normal[]; };
layout(binding = 10, scalar) readonly buffer DiscColors { vec4 disc_color[]; };
layout(binding = 11, scalar) readonly buffer Ids { uint id[]; };
layout(binding = 12, scalar) readonly buffer FreedAt { float freed_at[]; }; // by id, s

layout(binding = 13, scalar) readonly buffer Sizes { float size[]; }; // in radii, where params.sized
layout(binding = 14, scalar) readonly buffer DiscBends { vec4 disc_bend[]; };

layout(binding = 15, scalar) readonly buffer View { VisibilityParams view; }; // of the sheet of sand, as what follows
layout(binding = 16, scalar) readonly buffer Corners { vec4 corner[]; };
layout(binding = 17, scalar) readonly buffer CornerTints { vec4 corner_tint[]; };

#include "include/sand_sheet.glsl"

layout(location = 0) out vec4 out_color;

vec3 to_world(vec3 point) { return (params.view_to_world * vec4(point, 1.0)).xyz; }
vec3 to_world_direction(vec3 direction) { return mat3(params.view_to_world) * direction; }

// What a sample shows, in world space.
struct Surface {
    vec3 point;
    vec3 normal;
    vec3 albedo;
    Gloss gloss;
};

// --- particles and discs -------------------------------------------------------------------------------------------------

const vec3 LUMINANCE = vec3(0.2126, 0.7152, 0.0722); // of linear RGB (ITU-R BT.709)

float in_range(float value) { return (value - params.color_range.x) / (params.color_range.y - params.color_range.x); }

// How much of a solid's color a particle still has.
float solid_share(uint particle)
{
    uint state = particle_state(attributes[particle]);
    if (state != STATE_FLUID || cause_of(attributes[particle]) == CAUSE_NONE || params.blend_time <= 0.0) {
        return state == STATE_SOLID || state == STATE_DUST ? 1.0 : 0.0;
    }
    return 1.0 - smoothstep(0.0, params.blend_time, params.time - freed_at[id[particle]]);
}

vec3 particle_color(uint particle)
{
    uint material = min(particle_material(attributes[particle]), MAX_MATERIALS - 1u);
    vec3 color = mix(params.material_color[material], params.solid_color[material], solid_share(particle));
    if (params.color_mode != COLOR_MATERIAL && is_boundary(attributes[particle])) { // it has none of these quantities
        return vec3(dot(color, LUMINANCE));
    }
    switch (params.color_mode) {
    case COLOR_DENSITY:
        return density[particle] < params.rest_density[material] ? below_rest_color()
                                                                 : colormap(in_range(density[particle]));
    case COLOR_SPEED:
        return colormap(in_range(length(velocity[particle].xyz)));
    case COLOR_PRESSURE:
        return colormap(in_range(pressure[particle]));
    }
    return color;
}

Gloss particle_gloss(uint particle)
{
    if (params.color_mode != COLOR_MATERIAL) {
        return MATTE;
    }
    return particle_state(attributes[particle]) == STATE_FLUID ? WATER : STONE;
}

Surface sphere_surface(uint particle, Ray ray)
{
    vec3 center = (params.camera.view * vec4(position[particle].xyz, 1.0)).xyz;
    float miss;
    float radius = params.sized != 0u ? params.splat_radius * size[particle]
                                      : particle_radius(params.splat_radius, attributes[particle], density[particle]);
    vec3 point = intersect_sphere(params.camera, ray, center, radius, miss);
    vec3 normal = to_world_direction(normalize(point - center));
    bool is_puff = params.sized != 0u && is_flying_sand(attributes[particle]);
    normal = is_puff ? -view.direction : normal; // its specks are as bright as level sand
    return Surface(to_world(point), normal, particle_color(particle), particle_gloss(particle));
}

Surface disc_surface(uint disc, Ray ray)
{
    vec3 center = (params.camera.view * vec4(disc_position_radius[disc].xyz, 1.0)).xyz;
    vec3 normal = normalize(disc_normal[disc].xyz);
    vec3 seen_normal = mat3(params.camera.view) * normal;
    float rho_squared;
    vec3 point = intersect_disc(ray, center, seen_normal, disc_position_radius[disc].w, rho_squared);
    vec4 bend = disc_bend[disc];
    if (disc_normal[disc].w == DISC_BENT) {
        normal = bent_normal(normal, bend.xyz, to_world_direction(point - center));
    }
    normal = dot(seen_normal, ray.direction) > 0.0 ? -normal : normal;
    Gloss gloss = Gloss(mix(STONE.specular, WATER.specular, bend.w), mix(STONE.exponent, WATER.exponent, bend.w),
                        mix(STONE.rim, WATER.rim, bend.w));
    return Surface(to_world(point), normal, disc_color[disc].rgb, gloss);
}

// Of the sheet of sand: its triangles say where it is, and between their corners slopes turn steadily.
Surface sand_surface(uint triangle, Ray ray)
{
    uint quad = triangle / 2u;
    uint index[4];
    vec3 point[4];
    for (uint k = 0u; k < 4u; ++k) {
        uvec2 at = quad_corner(quad, k);
        index[k] = corner_index(at);
        point[k] = place_over_map(vec2(at), corner[index[k]].x);
    }
    vec3 origin = to_world(ray.origin);
    vec3 direction = to_world_direction(ray.direction);
    vec3 flat_normal = cross(point[2] - point[1], (triangle & 1u) == 0u ? point[0] - point[1] : point[3] - point[1]);
    vec3 hit = origin + dot(point[1] - origin, flat_normal) / dot(direction, flat_normal) * direction;
    vec2 at = place_on_map(hit).xy;
    vec2 f = clamp(at - vec2(quad % view.width, quad / view.width), 0.0, 1.0);
    vec2 slope = bilinear(corner[index[0]], corner[index[1]], corner[index[2]], corner[index[3]], f).yz;
    vec3 normal = normalize(-view.direction - slope.x * view.right - slope.y * view.up);
    vec3 color = bilinear(corner_tint[index[0]], corner_tint[index[1]], corner_tint[index[2]], corner_tint[index[3]], f).rgb;
    uvec2 grain = uvec2(max(at, 0.0) * GRAINS_A_SPACING);
    color *= 1.0 + GRAIN_CONTRAST * (2.0 * grain_share(grain.x, grain.y, 1u) - 1.0);
    return Surface(hit, normal, color, MATTE);
}

// --- floor -----------------------------------------------------------------------------------------------------------------

// Coverage of lines `spacing` apart, filtered over the pixel's footprint so that they fade instead of flickering.
float grid_lines(vec2 p, vec2 footprint, float spacing)
{
    float thickness = 0.008 * spacing;
    vec2 width = max(footprint, vec2(thickness));
    vec2 to_line = abs(fract(p / spacing + 0.5) - 0.5) * spacing;
    vec2 line = clamp(1.0 - to_line / width, 0.0, 1.0) * (thickness / width);
    return max(line.x, line.y);
}

// Where the ray meets the floor, how much of it is left of its fade, and its color; false where there is only background.
bool floor_hit(Ray ray, out vec3 hit, out float presence, out vec3 albedo)
{
    vec3 origin = to_world(ray.origin);
    vec3 direction = to_world_direction(ray.direction);
    float t = (params.floor_height - origin.y) / direction.y;
    hit = origin + t * direction;
    float radius = length(hit.xz - params.floor_center) / params.floor_extent;
    bool in_front = -(ray.origin.z + t * ray.direction.z) >= params.camera.near_distance;
    if (params.floor_extent <= 0.0 || direction.y >= 0.0 || !in_front || !(radius < 1.0)) {
        return false;
    }
    vec2 pixel = abs(params.camera.pixel * params.camera.plane_scale) * float(params.samples);
    float across = params.camera.orthographic != 0u ? pixel.x : pixel.x * t;
    vec2 footprint = vec2(across) / max(abs(direction.y), 0.02);
    albedo = params.floor_color * (1.0 - 0.10 * grid_lines(hit.xz, footprint, params.floor_grid));
    presence = 1.0 - smoothstep(0.35, 1.0, radius);
    return true;
}

// --- light -----------------------------------------------------------------------------------------------------------------

// Whether the way from a point to the light passes the bounds, grown by a particle: outside of them nothing casts shadows.
bool bounds_shade(vec3 world)
{
    vec3 inverse = 1.0 / params.light_direction;
    vec3 a = (params.box_min - params.splat_radius - world) * inverse;
    vec3 b = (params.box_max + params.splat_radius - world) * inverse;
    vec3 enter = min(a, b);
    vec3 leave = max(a, b);
    return max(max(max(enter.x, enter.y), enter.z), 0.0) <= min(min(leave.x, leave.y), leave.z);
}

// Share of the key light that reaches a point: percentage-closer filtering (Reeves, Salesin & Cook 1987) of 2 x 2 texels,
// or of 3 x 3 on the smooth floor, weighted by their overlap with a square around the point.
float key_light_at(vec3 world, vec3 normal, bool wide)
{
    if (params.shadows == 0u || dot(normal, params.light_direction) <= 0.0 || !bounds_shade(world)) {
        return 1.0;
    }
    float lift = 0.5 * params.splat_radius; // off the surface, or it would shade itself
    vec3 p = (params.light.view * vec4(world + normal * lift, 1.0)).xyz;
    vec2 ndc = (p.xy - params.light.plane_offset) / params.light.plane_scale;
    if (any(greaterThan(abs(ndc), vec2(1.0)))) {
        return 1.0;
    }
    // Behind the far plane nothing casts shadows: the cleared map, 0, must not shade it.
    float depth = max(depth_at(params.light, -p.z - lift), 0.0);

    vec2 size = vec2(textureSize(shadow_map, 0));
    vec2 at = 0.5 * (ndc + 1.0) * size - 0.5;
    vec2 corner = floor(at);
    vec2 f = at - corner;
    // A gather fetches the 2 x 2 texels (0,1) (1,1) (1,0) (0,0). Four of them cover texels -1..2 with weights 1-f 1 1 f.
    int gathers = wide ? 4 : 1;
    float lit = 0.0;
    for (int i = 0; i < gathers; ++i) {
        bvec2 upper = bvec2((i & 1) != 0, (i & 2) != 0);
        vec2 texel = wide ? corner + mix(vec2(0.0), vec2(2.0), upper) : corner + 1.0;
        vec2 low = wide ? mix(1.0 - f, vec2(1.0), upper) : 1.0 - f;
        vec2 high = wide ? mix(vec2(1.0), f, upper) : f;
        vec4 passes = step(textureGather(shadow_map, texel / size), vec4(depth));
        lit += dot(passes, vec4(low.x * high.y, high.x * high.y, high.x * low.y, low.x * low.y));
    }
    return wide ? lit / 9.0 : lit;
}

// --- the picture -------------------------------------------------------------------------------------------------------------

// Color of one sample. All surfaces meet in one look-up of the shadow, which is most of the work.
vec3 sample_color(uint visible, vec2 fragment)
{
    uint kind = visible >> SURFACE_SHIFT;
    uint index = visible & ((1u << SURFACE_SHIFT) - 1u);
    Ray ray = ray_through(params.camera, ndc_of_sample(params.camera, fragment));

    Surface surface;
    float presence = 1.0;
    if (kind == SURFACE_SPHERE) {
        surface = sphere_surface(index, ray);
    } else if (kind == SURFACE_DISC) {
        surface = disc_surface(index, ray);
    } else if (kind == SURFACE_SAND) {
        // One round, or none, as in disc.vert: who runs many pixels at once leaves it out where none of them shows sand.
        uint rounds = kind == SURFACE_SAND ? 1u : 0u;
        for (uint k = 0u; k < rounds; ++k) {
            surface = sand_surface(index, ray);
        }
    } else if (kind == SURFACE_LINE) {
        return params.line_color;
    } else if (floor_hit(ray, surface.point, presence, surface.albedo)) {
        surface.normal = vec3(0.0, 1.0, 0.0);
    } else {
        return params.background;
    }
    bool is_floor = kind == SURFACE_NONE;

    if (params.color_mode == COLOR_NORMAL && !is_floor) {
        return 0.5 * surface.normal + 0.5;
    }
    if (params.lit == 0u) {
        return mix(params.background, surface.albedo, presence);
    }
    float light = key_light_at(surface.point, surface.normal, is_floor);
    if (is_floor) {
        return mix(params.background, surface.albedo * (1.0 - FLOOR_SHADOW * (1.0 - light)), presence);
    }
    vec3 to_eye = to_world_direction(-ray.direction);
    return shade(surface.albedo, surface.gloss, surface.normal, to_eye, params.light_direction, light);
}

void main()
{
    int samples = int(params.samples);
    ivec2 first = ivec2(gl_FragCoord.xy) * samples;
    // Within a pixel a surface hardly changes: each is shaded once, where its first sample is, as often as it has samples.
    // They are found one after the other: whoever runs many pixels at once runs all of them as often as one needs it.
    int count = samples * samples;
    vec3 sum = vec3(0.0);
    uint done = 0u; // bits of samples
    while (done != (1u << count) - 1u) {
        int start = findLSB(~done);
        ivec2 at = first + ivec2(start % samples, start / samples);
        uint surface = texelFetch(visibility, at, 0).r;
        uint same = 0u;
        for (int i = start; i < count; ++i) {
            same |= texelFetch(visibility, first + ivec2(i % samples, i / samples), 0).r == surface ? 1u << i : 0u;
        }
        sum += float(bitCount(same)) * sample_color(surface, vec2(at) + 0.5);
        done |= same;
    }
    out_color = vec4(sum / float(count), 1.0);
}
