// From visible surfaces to the picture, where they are more than the floor: looks up what each sample shows, intersects it again for
// the exact point and normal, colors and lights it, and averages the samples of a pixel in linear light.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "include/shading.glsl"
#include "include/splat.glsl"
#include "include/picture.glsl"
#include "shared/sand_surface.h"
#include "shared/visibility.h"

layout(constant_id = 1) const bool SAND = false; // there is a sheet of sand

layout(binding = 3) uniform textureBuffer spheres; // of sphere_look.comp
layout(binding = 4) uniform textureBuffer looks;
layout(binding = 5) uniform textureBuffer disc_positions; // w: radius
layout(binding = 6) uniform textureBuffer disc_normals;   // w: DISC_*
layout(binding = 7) uniform textureBuffer disc_colors;
layout(binding = 8) uniform textureBuffer disc_bends;     // w: how wet it is
layout(binding = 9, scalar) uniform View { VisibilityParams view; }; // of the sheet of sand, as what follows
layout(binding = 10) uniform textureBuffer corners;
layout(binding = 11) uniform textureBuffer corner_tints;

#include "include/sand_sheet.glsl"

layout(location = 0) out vec4 out_color;

// What a sample shows, in world space.
struct Surface {
    vec3 point;
    vec3 normal;
    vec3 albedo;
    Gloss gloss;
};

// --- particles and discs -------------------------------------------------------------------------------------------------

Gloss gloss_of(float wet)
{
    Gloss gloss = Gloss(mix(STONE.specular, WATER.specular, wet), mix(STONE.exponent, WATER.exponent, wet), mix(STONE.rim, WATER.rim, wet));
    return wet == GLOSS_MATTE ? MATTE : wet == GLOSS_PUFF ? STONE : gloss;
}

Surface sphere_surface(int particle, Ray ray)
{
    vec4 sphere = texelFetch(spheres, particle);
    vec4 look = texelFetch(looks, particle);
    vec3 center = (params.camera.view * vec4(sphere.xyz, 1.0)).xyz;
    float miss;
    vec3 point = intersect_sphere(params.camera, ray, center, sphere.w, miss);
    vec3 normal = to_world_direction(normalize(point - center));
    normal = SAND && look.w == GLOSS_PUFF ? -view.direction : normal; // its specks are as bright as level sand
    return Surface(to_world(point), normal, look.rgb, gloss_of(look.w));
}

Surface disc_surface(int disc, Ray ray)
{
    vec4 position_radius = texelFetch(disc_positions, disc);
    vec4 normal_kind = texelFetch(disc_normals, disc);
    vec4 bend = texelFetch(disc_bends, disc);
    vec3 center = (params.camera.view * vec4(position_radius.xyz, 1.0)).xyz;
    vec3 normal = normalize(normal_kind.xyz);
    vec3 seen_normal = mat3(params.camera.view) * normal;
    float rho_squared;
    vec3 point = intersect_disc(ray, center, seen_normal, position_radius.w, rho_squared);
    if (normal_kind.w == DISC_BENT) {
        normal = bent_normal(normal, bend.xyz, to_world_direction(point - center));
    }
    normal = dot(seen_normal, ray.direction) > 0.0 ? -normal : normal;
    return Surface(to_world(point), normal, texelFetch(disc_colors, disc).rgb, gloss_of(bend.w));
}

// --- the picture -------------------------------------------------------------------------------------------------------------

// Of the sheet of sand: its triangles say where it is, and between their corners slopes turn steadily.
Surface sand_surface(int triangle, Ray ray)
{
    uint quad = uint(triangle) / 2u;
    uvec2 low = quad_corner(quad, 0u);
    uvec2 high = quad_corner(quad, 3u);
    int a = int(corner_index(low));
    int b = int(corner_index(uvec2(high.x, low.y)));
    int c = int(corner_index(uvec2(low.x, high.y)));
    int d = int(corner_index(high));
    vec4 at_a = texelFetch(corners, a);
    vec4 at_b = texelFetch(corners, b);
    vec4 at_c = texelFetch(corners, c);
    vec4 at_d = texelFetch(corners, d);
    bool is_lower = (uint(triangle) & 1u) == 0u; // a b c, or b c d
    vec3 point_b = place_over_map(vec2(high.x, low.y), at_b.x);
    vec3 point_c = place_over_map(vec2(low.x, high.y), at_c.x);
    vec3 third = is_lower ? place_over_map(vec2(low), at_a.x) : place_over_map(vec2(high), at_d.x);
    vec3 origin = to_world(ray.origin);
    vec3 direction = to_world_direction(ray.direction);
    vec3 flat_normal = cross(point_c - point_b, third - point_b);
    vec3 hit = origin + dot(point_b - origin, flat_normal) / dot(direction, flat_normal) * direction;
    vec2 at = place_on_map(hit).xy;
    vec2 f = clamp(at - vec2(low), 0.0, 1.0);
    vec2 slope = bilinear(at_a, at_b, at_c, at_d, f).yz;
    vec3 normal = normalize(-view.direction - slope.x * view.right - slope.y * view.up);
    vec3 color = bilinear(texelFetch(corner_tints, a), texelFetch(corner_tints, b), texelFetch(corner_tints, c), texelFetch(corner_tints, d), f).rgb;
    uvec2 grain = uvec2(max(at, 0.0) * GRAINS_A_SPACING);
    color *= 1.0 + GRAIN_CONTRAST * (2.0 * grain_share(grain.x, grain.y, 1u) - 1.0);
    return Surface(hit, normal, color, MATTE);
}

// Color of one sample. All surfaces meet in one look-up of the shadow, which is most of the work.
vec3 sample_color(uint visible, int i)
{
    uint kind = visible >> SURFACE_SHIFT;
    int index = int(visible & ((1u << SURFACE_SHIFT) - 1u));
    Ray ray = ray_of_sample(i);

    Surface surface;
    float presence = 1.0;
    if (kind == SURFACE_SPHERE) {
        surface = sphere_surface(index, ray);
    } else if (kind == SURFACE_DISC) {
        surface = disc_surface(index, ray);
    } else if (SAND && kind == SURFACE_SAND) {
        surface = sand_surface(index, ray);
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
        return floor_in_light(surface.albedo, presence, light);
    }
    return shade(surface.albedo, surface.gloss, surface.normal, to_world_direction(-ray.direction), params.light_direction, light);
}

void main()
{
    // Within a pixel a surface hardly changes: each is shaded once, where its first sample is, as often as it has samples.
    // They are found one after the other: whoever runs many pixels at once runs all of them as often as one needs it.
    uvec4 gathered = gathered_samples();
    vec3 sum = vec3(0.0);
    uint done = 0u; // bits of samples
    while (done != ALL_SAMPLES) {
        int first = findLSB(~done);
        uint surface = surface_of_sample(gathered, first);
        uint same = samples_of(gathered, surface);
        sum += float(bitCount(same)) * sample_color(surface, first);
        done |= same;
    }
    out_color = vec4(sum / float(SAMPLES * SAMPLES), 1.0);
}
