// Position based fluids (Macklin & Mueller, "Position Based Fluids", ACM Trans. Graph. 32(4), 2013), with masses: each fluid
// particle has the constraint C_i = rho_i / rho0_i - 1 = 0, or <= 0 where pressures are clamped. With g_ij = -grad W_ij, its
// rest volume V0_i = m_i / rho0_i and the weights s of shared/sph_params.h, an iteration moves it by
//
//     dx_i = sum_j ((X_i + A_i f(r)) s_j + (X_j + A_j f(r)) s_i) g_ij / m_i,    X_i = omega C_i / (V0_i R_i),
//     R_i = |sum_j s_j g_ij|^2 / m_i + sum_j |g_ij|^2 / m_j + softness / m_i,
//
// the second sum over fluid: equations 11 to 14, X_i = -V0_i lambda_i. Pairs move by m_i dx_i = -m_j dx_j: the center of mass
// stays where it is, whatever the masses. omega is SphParams::solve_relaxation, without which neighbors, all correcting the same
// error, would overshoot; the softness is the paper's relaxation eps (constraint force mixing), in parts of what a full lattice
// of neighbors responds with. f(r) = (W(r) / W(ARTIFICIAL_PRESSURE_DISTANCE))^4 and A_i, which is X_i for
// C_i = artificial_pressure, are the artificial pressure that keeps pairs apart (equation 13).
#ifndef MELTPOINT_SHARED_PBF_H
#define MELTPOINT_SHARED_PBF_H
#include "prelude.h"

SHARED_BEGIN

SHARED_CONSTANT float ARTIFICIAL_PRESSURE_DISTANCE = 0.4f; // in spacings; the paper has 0.1 to 0.3 support radii of about two

SHARED_END
#endif
