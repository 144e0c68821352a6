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

// Along which axes an image lies beyond the border.
bvec3 image_axes(uint image) { return notEqual(uvec3(image) & uvec3(1u, 2u, 4u), uvec3(0u)); }

// The same over the half planes beyond lines, over H^2: what engine/particles/sph_kernel.cpp has in closed form, but here without
// its differences of nearly equal terms, a polynomial fitted to 1.2e-6 of the value at the line.
vec3 half_plane_viscosity(vec3 q)
{
    vec3 u = 1.0 - q;
    vec3 tail = q * q * q * log(max(q, vec3(1e-6)));
    vec3 paper = 0.149197550 + u * (-0.0746778671 + u * 0.0335743702);
    paper = 0.754493356 + u * (-0.405407328 + u * (0.527638258 + u * (-0.461219445 + u * paper)));
    vec3 wendland = 1.06073575 + u * (-0.632061180 + u * 0.209447499);
    wendland = 0.293016026 + u * (-0.706866339 + u * (1.63762179 + u * (-1.70481372 + u * wendland)));
    return KERNEL == KERNEL_PAPER ? u * u * sqrt(u) * (paper - 0.213160664 * tail)
                                  : u * u * u * u * sqrt(u) * (wendland - 0.544664228 * tail);
}

// Integrals of the viscous Laplacian over the half spaces beyond planes at the distances s, divided by viscosity_scale, in
// m^3; zero from a support radius on.
vec3 half_space_viscosity(vec3 s, float support_radius)
{
    vec3 q = min(abs(s) / support_radius, vec3(1.0));
    if (DIMENSIONS == 2u) {
        vec3 beyond_line = half_plane_viscosity(q);
        float whole_plane = KERNEL == KERNEL_PAPER ? PI / 3.0 : PI / 10.0;
        return mix(beyond_line, whole_plane - beyond_line, lessThan(s, vec3(0.0))) * support_radius * support_radius;
    }
    vec3 u = 1.0 - q;
    vec3 u3 = u * u * u;
    vec3 beyond = KERNEL == KERNEL_PAPER ? PI / 6.0 * u3 * (1.0 + q) : PI / 30.0 * u3 * u * u * (1.0 + 2.0 * q);
    float whole = KERNEL == KERNEL_PAPER ? PI / 3.0 : PI / 15.0;
    return mix(beyond, whole - beyond, lessThan(s, vec3(0.0))) * support_radius * support_radius * support_radius;
}

#endif
