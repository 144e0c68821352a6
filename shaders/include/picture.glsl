// What both passes share that make the picture: the samples of a pixel, the floor, and the light that reaches a point. Include it
// after include/shading.glsl and include/splat.glsl.
#ifndef PICTURE_GLSL
#define PICTURE_GLSL

layout(constant_id = 0) const uint SAMPLES = 2u; // along a pixel's side

// A uniform buffer and texels: software devices load the words of storage buffers one by one.
layout(binding = 0, scalar) uniform Params { RenderParams params; };
layout(binding = 1) uniform usampler2D visibility;
layout(binding = 2) uniform sampler2D shadow_map;

vec3 to_world(vec3 point) { return (params.view_to_world * vec4(point, 1.0)).xyz; }
vec3 to_world_direction(vec3 direction) { return mat3(params.view_to_world) * direction; }

// --- samples ----------------------------------------------------------------------------------------------------------------

const uint ALL_SAMPLES = (1u << (SAMPLES * SAMPLES)) - 1u;

ivec2 place_of_sample(int i) { return ivec2(gl_FragCoord.xy) * int(SAMPLES) + ivec2(i % int(SAMPLES), i / int(SAMPLES)); }

// The four of a pixel at once, where they are four.
uvec4 gathered_samples()
{
    uvec4 seen = textureGather(visibility, gl_FragCoord.xy * 2.0 / vec2(textureSize(visibility, 0)));
    return seen.wzxy; // a gather fetches (0,1) (1,1) (1,0) (0,0)
}

uint surface_of_sample(uvec4 gathered, int i)
{
    if (SAMPLES == 2u) {
        return i == 0 ? gathered.x : i == 1 ? gathered.y : i == 2 ? gathered.z : gathered.w;
    }
    return texelFetch(visibility, place_of_sample(i), 0).r;
}

// The samples, a bit each, that show such a surface.
uint samples_of(uvec4 gathered, uint surface)
{
    if (SAMPLES == 2u) {
        uvec4 bits = uvec4(equal(gathered, uvec4(surface))) << uvec4(0u, 1u, 2u, 3u);
        return bits.x | bits.y | bits.z | bits.w;
    }
    uint found = 0u;
    for (int i = 0; i < int(SAMPLES * SAMPLES); ++i) {
        found |= texelFetch(visibility, place_of_sample(i), 0).r == surface ? 1u << i : 0u;
    }
    return found;
}

Ray ray_of_sample(int i) { return ray_through(params.camera, ndc_of_sample(params.camera, vec2(place_of_sample(i)) + 0.5)); }

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

// light: share of the key light that arrives; presence: how much of the floor is left of its fade.
vec3 floor_in_light(vec3 albedo, float presence, float light)
{
    return mix(params.background, albedo * (1.0 - FLOOR_SHADOW * (1.0 - light)), presence);
}

// What the floor looks like along a ray, or the background.
vec3 floor_color(Ray ray)
{
    vec3 point;
    float presence;
    vec3 albedo;
    if (!floor_hit(ray, point, presence, albedo)) {
        return params.background;
    }
    float light = params.lit != 0u ? key_light_at(point, vec3(0.0, 1.0, 0.0), true) : 1.0;
    return floor_in_light(albedo, presence, light);
}

#endif
