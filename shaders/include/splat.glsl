// Spheres and discs seen by a camera: exact intersections, exact depth, and tight bounds on screen.
//
// Bounds are made in the view plane (render_params.h), where perspective is already divided out. The extent of a disc is
// that of its dual conic (Botsch et al. 2005; Sigg et al. 2006), written so that nothing cancels for small far discs; of a
// sphere, the tangents from the eye. Whatever crosses the near plane is bounded by its part beyond it.
#ifndef SPLAT_GLSL
#define SPLAT_GLSL
#extension GL_EXT_samplerless_texture_functions : require
#include "include/tangent_frame.glsl"
#include "shared/render_params.h"

struct Ray {
    vec3 origin;
    vec3 direction; // unit length
};

vec2 ndc_of_sample(SplatCamera camera, vec2 fragment) { return fragment * camera.pixel - 1.0; }

Ray ray_through(SplatCamera camera, vec2 ndc)
{
    vec2 plane = ndc * camera.plane_scale + camera.plane_offset;
    if (camera.orthographic != 0u) {
        return Ray(vec3(plane, 0.0), vec3(0.0, 0.0, -1.0));
    }
    return Ray(vec3(0.0), normalize(vec3(plane, -1.0)));
}

float depth_at(SplatCamera camera, float distance)
{
    float x = camera.orthographic != 0u ? distance : 1.0 / distance;
    return camera.depth_map.x + camera.depth_map.y * x;
}

bool in_depth_range(SplatCamera camera, vec3 point)
{
    return -point.z >= camera.near_distance && -point.z <= camera.far_distance;
}

// --- intersections, view space -----------------------------------------------------------------------------------------

// The nearest point of the sphere on the ray that is not cut away by the near plane. A ray that misses is taken to touch
// where it comes nearest, and `miss` is how far outside it passes (squared, relative to the radius; <= 0: a hit).
vec3 intersect_sphere(SplatCamera camera, Ray ray, vec3 center, float radius, out float miss)
{
    vec3 to_center = center - ray.origin;
    float along = dot(to_center, ray.direction);
    vec3 off_axis = to_center - along * ray.direction;
    float half_chord_squared = radius * radius - dot(off_axis, off_axis);
    miss = -half_chord_squared / (radius * radius);
    float half_chord = sqrt(max(half_chord_squared, 0.0));
    vec3 front = ray.origin + (along - half_chord) * ray.direction;
    return -front.z >= camera.near_distance ? front : ray.origin + (along + half_chord) * ray.direction;
}

// The point of the disc's plane on the ray; rho_squared <= 1 inside the disc. A plane seen edge-on gives infinity or NaN.
vec3 intersect_disc(Ray ray, vec3 center, vec3 normal, float radius, out float rho_squared)
{
    float t = dot(center - ray.origin, normal) / dot(ray.direction, normal);
    vec3 point = ray.origin + t * ray.direction;
    vec3 q = point - center;
    rho_squared = dot(q, q) / (radius * radius);
    return point;
}

// --- bounds in the view plane: (low, high) along one axis ---------------------------------------------------------------

const vec2 NOWHERE = vec2(1.0, -1.0);

// x: the center's coordinate along the axis, d: its distance along the view axis.
vec2 sphere_range(SplatCamera camera, float x, float d, float radius)
{
    if (camera.orthographic != 0u) {
        return vec2(x - radius, x + radius);
    }
    // In the plane of the axis and the view direction the sphere is a circle, and the near plane cuts it along a chord.
    float near = camera.near_distance;
    float eye_squared = x * x + d * d;
    float tangent = sqrt(max(eye_squared - radius * radius, 0.0));
    float chord = sqrt(max(radius * radius - (near - d) * (near - d), 0.0));
    vec2 side = vec2(-1.0, 1.0);
    vec2 touch = x * tangent + side * radius * d; // with this distance: a direction, not a point
    vec2 distance = d * tangent - side * radius * x;
    bvec2 beyond_near = greaterThanEqual(distance * tangent, vec2(near * eye_squared));
    return mix((x + side * chord) / near, touch / distance, beyond_near);
}

// n: the normal along the axis, m: along the view direction, other: along the third axis.
vec2 disc_range(SplatCamera camera, float x, float d, float n, float m, float other, float radius)
{
    if (camera.orthographic != 0u) {
        float extent = radius * sqrt(max(1.0 - n * n, 0.0));
        return vec2(x - extent, x + extent);
    }
    float cross_term = x * m - d * n;
    float r2 = radius * radius;
    float determinant = d * d - r2 * (1.0 - m * m);
    float middle = (x * d + r2 * n * m) / determinant;
    float extent =
        radius * sqrt(max(x * x + d * d - cross_term * cross_term - r2 * other * other, 0.0)) / abs(determinant);
    return vec2(middle - extent, middle + extent);
}

// A disc that crosses the near plane: its bounding square, clipped against that plane.
vec4 clipped_disc_bound(SplatCamera camera, vec3 center, vec3 normal, float radius)
{
    vec3 u = radius * normalize(cross(normal, abs(normal.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 1, 0)));
    vec3 v = cross(normal, u);
    vec2 low = vec2(3.0e38);
    vec2 high = vec2(-3.0e38);
    for (int i = 0; i < 4; ++i) {
        vec3 a = center + (i == 1 || i == 2 ? u : -u) + (i >= 2 ? v : -v); // counterclockwise
        vec3 b = center + (i <= 1 ? u : -u) + (i == 1 || i == 2 ? v : -v);
        float excess_a = -a.z - camera.near_distance;
        float excess_b = -b.z - camera.near_distance;
        if (excess_a >= 0.0) {
            low = min(low, a.xy / -a.z);
            high = max(high, a.xy / -a.z);
        }
        if ((excess_a >= 0.0) != (excess_b >= 0.0)) {
            vec2 cut = mix(a.xy, b.xy, excess_a / (excess_a - excess_b)) / camera.near_distance;
            low = min(low, cut);
            high = max(high, cut);
        }
    }
    return vec4(low, high);
}

// (low x, low y, high x, high y); empty where the sphere lies before the near or behind the far plane, or is not finite.
vec4 sphere_bound(SplatCamera camera, vec3 center, float radius)
{
    float d = -center.z;
    if (!(d + radius >= camera.near_distance && d - radius <= camera.far_distance)) {
        return NOWHERE.xxyy;
    }
    vec2 x = sphere_range(camera, center.x, d, radius);
    vec2 y = sphere_range(camera, center.y, d, radius);
    return vec4(x.x, y.x, x.y, y.y);
}

vec4 disc_bound(SplatCamera camera, vec3 center, vec3 normal, float radius)
{
    float d = -center.z;
    float reach = radius * sqrt(max(1.0 - normal.z * normal.z, 0.0));
    if (!(d + reach >= camera.near_distance && d - reach <= camera.far_distance)) {
        return NOWHERE.xxyy;
    }
    if (camera.orthographic == 0u && d - reach < camera.near_distance) {
        return clipped_disc_bound(camera, center, normal, radius);
    }
    vec2 x = disc_range(camera, center.x, d, normal.x, -normal.z, normal.y, radius);
    vec2 y = disc_range(camera, center.y, d, normal.y, -normal.z, normal.x, radius);
    return vec4(x.x, y.x, x.y, y.y);
}

// --- the quad that covers a bound ----------------------------------------------------------------------------------------

const vec4 NO_QUAD = vec4(2.0, 2.0, 0.0, 1.0); // outside of the screen
const float BOUND_MARGIN = 0.25; // samples: more than rasterization rounds positions by

// The quad around a bound, (low x, low y, high x, high y) in ndc, clipped to the screen; false where nothing of it is there.
bool quad_on_screen(SplatCamera camera, vec4 bound, out vec4 quad)
{
    vec2 a = (bound.xy - camera.plane_offset) / camera.plane_scale;
    vec2 b = (bound.zw - camera.plane_offset) / camera.plane_scale;
    vec2 low = max(min(a, b) - BOUND_MARGIN * camera.pixel, vec2(-1.0));
    vec2 high = min(max(a, b) + BOUND_MARGIN * camera.pixel, vec2(1.0));
    quad = vec4(low, high);
    return bound.x <= bound.z && bound.y <= bound.w && low.x < high.x && low.y < high.y;
}

// The depth of a quad, that of the splat's nearest point: no fragment is nearer, which lets a device reject hidden quads before
// shading (depth_less).
float quad_depth(SplatCamera camera, float nearest)
{
    const float slack = 1.0 + 1e-6; // interpolation may round the depth down
    return min(depth_at(camera, max(nearest, camera.near_distance)) * slack, 1.0);
}

// Which corner each of a quad's six vertices is: 0 1 2, 2 1 3.
uint corner_of_vertex(uint vertex) { return vertex < 3u ? vertex : (vertex == 3u ? 2u : (vertex == 4u ? 1u : 3u)); }

// Clip-space position of one of them.
vec4 quad_vertex(vec4 quad, float depth, uint vertex)
{
    uint corner = corner_of_vertex(vertex);
    return vec4((corner & 1u) != 0u ? quad.z : quad.x, (corner & 2u) != 0u ? quad.w : quad.y, depth, 1.0);
}

// A disc's normal where it is met, q off its center, all in one space: `normal` in the middle, and bend.x, y, z say how much
// of u, of u and v, and of v it takes on a meter along u, along v and u, and along v (tangent_frame).
vec3 bent_normal(vec3 normal, vec3 bend, vec3 q)
{
    vec3 u;
    vec3 v;
    tangent_frame(normal, u, v);
    vec2 at = vec2(dot(q, u), dot(q, v));
    return normalize(normal + dot(bend.xy, at) * u + dot(bend.yz, at) * v);
}

#endif
