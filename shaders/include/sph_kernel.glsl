// The smoothing kernels, without their scales (SphParams): the loops sum shapes, the scale multiplies the sum once.
// Mueller, Charypar & Gross 2003 (poly6, spiky, viscosity); Wendland 1995 (C2). C++ twin: engine/particles/sph_kernel.
#ifndef SPH_KERNEL_GLSL
#define SPH_KERNEL_GLSL
#include "shared/sph_params.h"

layout(constant_id = 0) const uint KERNEL = KERNEL_PAPER;
layout(constant_id = 10) const uint DIMENSIONS = 3u;

// What the pairs of one pass share.
struct KernelSize {
    float inverse_h;    // 1/H
    float inverse_h2;   // 1/H^2
    float coincident2;  // squared distance under which a pair has no direction
};

KernelSize kernel_size(float support_radius)
{
    float inverse_h = 1.0 / support_radius;
    float coincident = COINCIDENT_RATIO * support_radius;
    return KernelSize(inverse_h, inverse_h * inverse_h, coincident * coincident);
}

// W / density_scale at squared distance r2.
float density_shape(float r2, KernelSize size)
{
    if (KERNEL == KERNEL_PAPER) {
        float x = max(1.0 - r2 * size.inverse_h2, 0.0);
        return x * x * x;
    }
    float q = min(sqrt(r2) * size.inverse_h, 1.0);
    float u = 1.0 - q;
    float u2 = u * u;
    return u2 * u2 * (1.0 + 4.0 * q);
}

// Whether a pair has a direction; coincident pairs have none, and no gradient.
bool has_direction(float r2, KernelSize size) { return r2 > size.coincident2; }

// x: -W' / (gradient_scale r), so that the gradient is -x * (vector from j to i) for pairs that have a direction;
// y: viscous Laplacian / viscosity_scale.
vec2 force_shapes(float r2, KernelSize size)
{
    if (KERNEL == KERNEL_PAPER) {
        float inverse_r = inversesqrt(max(r2, size.coincident2));
        float u = max(1.0 - r2 * inverse_r * size.inverse_h, 0.0);
        return vec2(u * u * inverse_r, u);
    }
    float u = max(1.0 - sqrt(r2) * size.inverse_h, 0.0);
    float u3 = u * u * u;
    return vec2(u3 * size.inverse_h, u3);
}

// Of the viscous forces along the line of a pair / pair_viscosity_scale, the same for all kernels. The taper makes a lattice
// resist shear along its axes as it does along its diagonals.
float pair_viscosity_shape(float r2, float taper, KernelSize size)
{
    float u = max(1.0 - sqrt(r2) * size.inverse_h, 0.0);
    return u * (1.0 + taper * u);
}

// The color field's kernel. x: -W' / (color_gradient_scale r); y: Laplacian / color_laplacian_scale.
vec2 color_shapes(float r2, KernelSize size)
{
    if (KERNEL == KERNEL_PAPER) {
        float q2 = r2 * size.inverse_h2;
        float x = max(1.0 - q2, 0.0);
        return vec2(x * x * size.inverse_h, -x * (DIMENSIONS == 3u ? 3.0 - 7.0 * q2 : 1.0 - 3.0 * q2));
    }
    float q = min(sqrt(r2) * size.inverse_h, 1.0);
    float u = 1.0 - q;
    return vec2(u * u * u * size.inverse_h, -u * u * (1.0 - (DIMENSIONS == 3u ? 2.0 : 2.5) * q));
}

#endif
