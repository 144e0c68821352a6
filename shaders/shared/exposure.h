// Where solids are exposed, after the color field of the paper (Mueller, Charypar & Gross 2003, section 3.3), here of what is
// solid: c_i = sum_j V_j W_ij over solids and colliders, with Wendland's kernel of a support radius of its own, whatever that of
// the fluid. The normal is n = -grad c / |grad c|, the exposed area A = 2 V |grad c|, V = s d^3: twice, since only the solid's
// side of the surface has particles to share it.
//
// The scale of A is such that the layers of a lattice add up to a flat face along its axes (as lattice moments do for the other
// kernels, shared/sph_params.h): the first layer has 78 % of it, the second 22 %. Faces askew to the lattice have 2 to 7 % less,
// a ball of radius 11.5 d 9 %.
//
// What is thin has too little of that, a lone particle none, for its sides cancel out: where c is small, A is at least the part
// of the particle's faces that c lacks.
#ifndef MELTPOINT_SHARED_EXPOSURE_H
#define MELTPOINT_SHARED_EXPOSURE_H
#include "prelude.h"

SHARED_BEGIN

SHARED_CONSTANT float EXPOSURE_SUPPORT = 3.5f; // support radius, in spacings

// Particles with less, as a share of the face of a lattice cell, lie inside, with neither A nor n: what they have comes from
// disorder. Inside a solid whose particles are up to 0.1 d off their lattice along each axis it is 0.04 on average, and seldom
// more than 0.1; the third layer of a lattice has 0.005 to 0.03.
SHARED_CONSTANT float LEAST_EXPOSURE = 0.1f;

// c below which a particle is taken to be of something thin: at a flat face it is 0.71, at the edge of a cube 0.51, at its
// corner 0.36, in a sheet, in a chain and of a lone particle 0.43, 0.18 and 0.08.
SHARED_CONSTANT float THIN_FILLING = 0.55f;

// Fluid a spacing off a surface covers it where it fills so much of the space: it erodes there, and sun and air do not reach it.
SHARED_CONSTANT float COVER_FILLING = 0.5f;

struct ExposurePush {
    float area_scale;    // A over |sum_j s_j q (1-q)^3 x_ij / r_ij| and the face of a lattice cell, s_j the weights
    float filling_scale; // c over sum_j s_j (1-q)^4 (1+4q)
    float faces;         // of a lattice cell
    uint first;       // of the particles in their order, the one to begin with
    uint count;       // of them
    uint any_loose;   // 1 where some solids lie among the moving particles
    uint round;       // only in cells that are marked with it; 0: in all
};

SHARED_END
#endif
