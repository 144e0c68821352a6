#pragma once

#include <cstdint>

#include "shared/sph_params.h"

namespace meltpoint {

/// The kernels of SPH in three dimensions, or in two where `dimensions` is 2, in double precision. `kernel` is
/// shared::KERNEL_PAPER (poly6 for density and color field, spiky for pressure, viscosity Laplacian; Müller, Charypar &
/// Gross 2003) or shared::KERNEL_WENDLAND (Wendland C2 for all; Wendland 1995, Dehnen & Aly 2012).
///
/// Every kernel is a scale times a shape. The shape is a pure number, a function of q = r/H, zero for q >= 1; the scale
/// carries the units and depends on the support radius H and the dimensions alone. Units are those of three dimensions:
/// in two a meter less, of volumes as of all that is divided by them.

/// W = density scale * shape.
[[nodiscard]] double density_shape(std::uint32_t kernel, double q);

/// W'(r) = -gradient scale * shape: the radial derivative of the kernel that pressure uses.
[[nodiscard]] double gradient_shape(std::uint32_t kernel, double q);

/// L = viscosity scale * shape, L > 0. Paper: a Laplacian made to be positive. Wendland: -2 W'/r (Morris, Fox & Zhu
/// 1997).
[[nodiscard]] double viscosity_shape(std::uint32_t kernel, double q);

/// W'(r) = -color gradient scale * shape, the radial derivative of the color field's kernel.
[[nodiscard]] double color_gradient_shape(std::uint32_t kernel, double q);

/// lap W = -color Laplacian scale * shape, the Laplacian of the color field's kernel.
[[nodiscard]] double color_laplacian_shape(std::uint32_t kernel, double q, std::uint32_t dimensions = 3);

/// Of the viscous forces along the line of a pair, solved for: u (1 + taper u) with u = 1 - q, the same for all
/// kernels.
[[nodiscard]] double pair_viscosity_shape(double taper, double q);

struct KernelScales {
    double density;         ///< 1/m^3
    double gradient;        ///< 1/m^4
    double viscosity;       ///< 1/m^5
    double color_gradient;  ///< 1/m^4
    double color_laplacian; ///< 1/m^5
};

/// The scales whose kernels integrate to one. support_radius in meters.
[[nodiscard]] KernelScales continuum_scales(std::uint32_t kernel, double support_radius, std::uint32_t dimensions = 3);

/// What the kernel sums give on a cubic lattice of spacing d, in two dimensions a square one of cells d^2; each is 1 in
/// the continuum (Monaghan 2005, section 2).
struct LatticeMoments {
    double density;         ///< sum d^3 W, self included
    double gradient;        ///< -sum d^3 x dW/dx
    double viscosity;       ///< 1/2 sum d^3 x^2 L
    double color_gradient;  ///< -sum d^3 x dW/dx
    double color_laplacian; ///< 1/2 sum d^3 x^2 lap W
};

/// support_radius and spacing in meters. Throws Error{Input} unless MIN_SUPPORT_RATIO <= H/d <= MAX_SUPPORT_RATIO.
[[nodiscard]] LatticeMoments lattice_moments(std::uint32_t kernel, double support_radius, double spacing,
                                             std::uint32_t dimensions = 3);

/// The viscous forces of pairs where viscosity is solved for: particle i feels mu V_i V_j scale shape(q) x x^T (v_j -
/// v_i), x the unit vector from j to i. The scale makes them those of a fluid of viscosity mu (1/2 sum d^n r^2 L = n
/// with L = scale shape / (n + 2) in n dimensions, Monaghan 2005, section 9.2). A lattice resists shear along its axes
/// as along its diagonals only if its fourth moments are isotropic: the taper makes them so, or nearly so where that
/// would take too odd a shape.
struct PairViscosity {
    double scale; ///< 1/m^5
    double taper;
};

/// support_radius and spacing in meters. Throws as lattice_moments.
[[nodiscard]] PairViscosity pair_viscosity(double support_radius, double spacing, std::uint32_t dimensions = 3);

/// What the density of a particle of that lattice responds with to its neighbors' moves, sum_j |grad W_ij|^2 over the
/// squared gradient scale: the unit of params.constraint_softness. Throws as lattice_moments.
[[nodiscard]] double lattice_response(std::uint32_t kernel, double support_radius, double spacing,
                                      std::uint32_t dimensions = 3);

/// The largest eigenvalue of the pressure solves' Jacobi matrix on that lattice, where it is about 3 at H = 2 d and 6
/// at 3 d: plane waves of pressure are its eigenvectors, with the eigenvalues |sum_j g_j sin(k . x_j)|^2 / sum_j
/// |g_j|^2, g_j the kernel gradients. Jacobi iterations converge when relaxed by less than 2 over it. Throws as
/// lattice_moments.
[[nodiscard]] double largest_jacobi_eigenvalue(std::uint32_t kernel, double support_radius, double spacing,
                                               std::uint32_t dimensions = 3);

/// The fastest decay of a temperature on that lattice by conduction (shared/heat.h), over its diffusivity, 1/m^2: plane
/// waves are the eigenvectors, with the eigenvalues d^n sum_j L_j (1 - cos(k . x_j)), where L = -2 W'/r is divided by
/// its moment, which is that of the gradient: 1/2 d^n sum_j x_j^2 L_j = -d^n sum_j x_j dW/dx_j. An explicit step is
/// stable below 2 over diffusivity and eigenvalue. Throws as lattice_moments.
[[nodiscard]] double largest_conduction_eigenvalue(std::uint32_t kernel, double support_radius, double spacing,
                                                   std::uint32_t dimensions = 3);

/// |n| H in the two outermost layers of that lattice where it ends in a flat surface, half a spacing and one and a half
/// below it: of n = d^3 sum_j grad W_ij, smoothed as shared/capillarity.h does. Throws as lattice_moments.
struct LayerSteepness {
    double first;
    double second;
    double beyond; ///< where the surface stands on a solid: the part of n of its lowest layer that fluid in the solid's
                   ///< place would have
};
[[nodiscard]] LayerSteepness surface_layers(std::uint32_t kernel, double support_radius, double spacing,
                                            std::uint32_t dimensions = 3);

/// ExposurePush::area_scale (shared/exposure.h), such that the exposed areas of a lattice with a flat face along its
/// axes add up to that face.
[[nodiscard]] double exposed_area_scale(std::uint32_t dimensions = 3);

/// shared::ExposurePush::filling_scale: 1 over the sum of the kernel's shape on a lattice (shared/exposure.h).
[[nodiscard]] double solid_filling_scale(std::uint32_t dimensions);

inline constexpr double MIN_SUPPORT_RATIO = 1.2; ///< below, a lattice has hardly any neighbors left
inline constexpr double MAX_SUPPORT_RATIO = 8.0; ///< above, a particle has more than 2100 neighbors

/// What the half space (in two dimensions the half plane) beyond a plane wall adds to the sum of L, 1/m^2: its integral
/// there. `distance` is the particle's signed distance to the wall in meters, positive inside; the kernel is that of
/// the continuum.
[[nodiscard]] double wall_viscosity_integral(std::uint32_t kernel, double distance, double support_radius,
                                             std::uint32_t dimensions = 3);

/// The same viscosity (Pa s) for every fluid.
inline void set_viscosity(shared::SphParams& params, float viscosity)
{
    for (float& each : params.viscosity) {
        each = viscosity;
    }
}

/// Fills the spacing (m), the volume of a lattice cell and what follows from them, kernel, support radius and speed of
/// sound: the five kernel scales divided by their lattice moments, the relaxation of pressure solves, the unit of
/// artificial pressure, and the contact spring. params.support_radius and params.speed_of_sound must be set. Throws as
/// lattice_moments does.
void set_kernel_scales(shared::SphParams& params, std::uint32_t kernel, double spacing, std::uint32_t dimensions = 3);

} // namespace meltpoint
