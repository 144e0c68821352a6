// Surface tension and contact angles in SI units: a force on the particles at the surface, from the surface's curvature
// (Brackbill, Kothe & Zemach, "A continuum method for modeling surface tension", J. Comput. Phys. 100, 1992; in SPH:
// Morris, Int. J. Numer. Meth. Fluids 33, 2000). Of fluid particle i with the tension sigma_i, in three passes:
//
// 1. surface_normal.comp: n_i = d^3 sum_j s_j grad W_ij, with the pressure's kernel, over fluid, its images and
// boundary particles. It
//    points into the fluid; its integral through a surface is 1/2. At a solid, which neither side of the line of
//    contact may pull at, n_i is turned into the solid's plane, and the normal that curvature is taken of to the
//    contact angle (Brackbill's wall adhesion): what Young's law (1805) asks of the line, sigma (1 + cos theta) being
//    the work of adhesion (Dupre 1869).
// 2. smooth_normal.comp, NORMAL_SMOOTHINGS times: n'_i = sum_j n_j W_ij / sum_j W_ij over fluid. Curvature is a
// derivative of
//    normals; those of single particles would make it boil.
// 3. capillarity.comp: with outward normals m = -n'/|n'| and w_ij = (1 - q)^2 for fluid near a surface,
//        kappa_i = (D - 1) sum_j w_ij (m_j - m_i) . x_ji / sum_j w_ij (|x_ji|^2 - (x_ji . m_i)^2),
//    D the dimensions, is the curvature at i, some way below the surface. Of that way tells |n'_i|, whose values in the
//    two outermost layers of a lattice are known. With the curvature of the surface, a_i = 2 sigma_i kappa_i n_i /
//    rho_i.
//
// Why n_i itself and not n'_i: a drop whose pressure is sigma kappa everywhere is then at rest exactly, since the
// pressure force of equal pressures is -2 p n_i / rho_i. With anything else the outer layers would be squeezed, by
// first order in d/R.
//
// The surface's density is below rest density, so pressure does not part particles there: they would pair up, and the
// curvature of their jitter feeds in energy. Two forces of pairs, which keep momentum, prevent it: a repulsion nearer
// than CROWDING_DISTANCE, and a viscosity at the surface of SURFACE_DRAG sqrt(sigma rho d), which vanishes with finer
// particles. Everything else conserves momentum as far as the curvature is right: for a constant one exactly.
#ifndef MELTPOINT_SHARED_CAPILLARITY_H
#define MELTPOINT_SHARED_CAPILLARITY_H
#include "prelude.h"

SHARED_BEGIN

SHARED_CONSTANT uint NORMAL_SMOOTHINGS = 3u;

// |n'| H: up to the first a particle is inside, from the second on at a surface.
SHARED_CONSTANT float INSIDE_STEEPNESS = 0.1f;
SHARED_CONSTANT float SURFACE_STEEPNESS = 0.2f;

// The smallest part of sum_j w_ij |x_ji|^2 that may lie along the surface: where less does, neighbors do not tell a
// curvature.
SHARED_CONSTANT float LEAST_SPREAD = 0.1f;

SHARED_CONSTANT float CROWDING_DISTANCE = 0.8f; // spacings; the force is sigma d (1 - r/r0)

// Of curvature the last particles of an edge, or of a bump, know nothing, and pressure would blow them off. Where a
// particle is filled by neighbors to less than LOOSE_FILLING, at the latest to LEAST_FILLING (a flat surface has 0.75
// to 0.9), pairs also attract each other, by up to sigma d halfway between the spacing and the support radius.
SHARED_CONSTANT float LOOSE_FILLING = 0.6f;
SHARED_CONSTANT float LEAST_FILLING = 0.3f;

SHARED_CONSTANT float SURFACE_DRAG = 0.3f;

// What a solid nearby says of the line of contact: `closeness` is 1 of the layer that touches it.
SHARED_CONSTANT float CONTACT_REACH =
    1.5f; // spacings from a wall, where closeness has fallen to 0; it is 1 a spacing nearer

SHARED_END
#endif
