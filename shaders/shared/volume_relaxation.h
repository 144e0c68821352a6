// Solids that melt to another volume. Their particles have the mass of a fluid particle, rho0 d^3 of the fluid, and lie
// as far apart as their own density asks: so they are weighted with their volume over that of their fluid, s = rho0 /
// rho_solid, and number densities around them are those of a fluid at rest.
//
// Freed, a particle is at rest yet: m_i sum_j s_j W_ij = rho0. Its weight relaxes to a fluid particle's, 1, over many
// steps: ice shrinks, wax swells, without a kick. What becomes solid again keeps the weight that it has: it cannot push
// others aside.
#ifndef MELTPOINT_SHARED_VOLUME_RELAXATION_H
#define MELTPOINT_SHARED_VOLUME_RELAXATION_H
#include "prelude.h"

SHARED_BEGIN

SHARED_CONSTANT float VOLUME_RELAXATION_STEPS = 100.0f; // in which most of the difference is gone
SHARED_CONSTANT float VOLUME_TOLERANCE = 1e-3f;        // of the weight, that is no difference any more

// The weight of fluid after another step.
SHARED_FUNCTION float relaxed_weight(float weight)
{
    float left = (weight - 1.0f) * (1.0f - 1.0f / VOLUME_RELAXATION_STEPS);
    return left < VOLUME_TOLERANCE && left > -VOLUME_TOLERANCE ? 1.0f : 1.0f + left;
}

SHARED_END
#endif
