// The walls of the box are mirrors: the fluid beyond a wall is the image of the fluid inside. Images supply density and
// pressure, conserve energy as the particles themselves do, and leave a lattice whose first layer lies half a spacing off the
// wall exactly at rest. Near an edge there are images of images. Instead of the neighbors, each tile's own positions are
// reflected: an image of j is as far from i as j is from the image of i. C++ twin: engine/reference/walls.
#ifndef WALLS_GLSL
#define WALLS_GLSL
#include "include/neighbor_walk.glsl"
#include "include/sph_kernel.glsl"

const float PI = 3.14159265358979;
const float NO_WALL = 1e30;

// The number of an image has one bit an axis: 0 is the particle itself.

// Along each axis the nearer wall: a box is at least two support radii wide, so the other one is out of reach.
struct Walls {
    vec3 plane;    // m, coordinate along its axis
    vec3 distance; // m, positive inside; NO_WALL where there is none
    vec3 normal;   // component of the inward normal along its axis: +1 or -1
};

Walls nearest_walls(vec3 x, vec3 domain_min, vec3 domain_max, uint wall_mask)
{
    vec3 lower = mix(vec3(NO_WALL), x - domain_min, notEqual(uvec3(wall_mask) & uvec3(1u, 4u, 16u), uvec3(0u)));
    vec3 upper = mix(vec3(NO_WALL), domain_max - x, notEqual(uvec3(wall_mask) & uvec3(2u, 8u, 32u), uvec3(0u)));
    bvec3 is_lower = lessThanEqual(lower, upper);
    return Walls(mix(domain_max, domain_min, is_lower), min(lower, upper), mix(vec3(-1.0), vec3(1.0), is_lower));
}

// Along which axes an image reflects.
bvec3 image_axes(uint image) { return notEqual(uvec3(image) & uvec3(1u, 2u, 4u), uvec3(0u)); }

// Reflects a vector, or takes it back: -1 along the axes that the image reflects, 1 along the others.
vec3 image_signs(uint image) { return mix(vec3(1.0), vec3(-1.0), image_axes(image)); }

// The position's image, NOWHERE if one of its walls is out of reach.
vec3 image_position(vec3 x, uint image, Walls walls, float support_radius)
{
    bvec3 axes = image_axes(image);
    vec3 distance = mix(vec3(0.0), walls.distance, axes);
    bool in_reach = all(lessThan(distance, vec3(support_radius)));
    return in_reach ? mix(x, 2.0 * walls.plane - x, axes) : NOWHERE;
}

// Integrals of the viscous Laplacian over the half spaces beyond planes at the distances s, divided by viscosity_scale, in
// m^3; zero from a support radius on.
vec3 half_space_viscosity(vec3 s, float support_radius)
{
    vec3 q = min(abs(s) / support_radius, vec3(1.0));
    vec3 u = 1.0 - q;
    vec3 u3 = u * u * u;
    vec3 beyond = KERNEL == KERNEL_PAPER ? PI / 6.0 * u3 * (1.0 + q) : PI / 30.0 * u3 * u * u * (1.0 + 2.0 * q);
    float whole = KERNEL == KERNEL_PAPER ? PI / 3.0 : PI / 15.0;
    return mix(beyond, whole - beyond, lessThan(s, vec3(0.0))) * support_radius * support_radius * support_radius;
}

#endif
