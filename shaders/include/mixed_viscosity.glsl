// Pairs of fluids that differ in viscosity have the harmonic mean of the two: with it the stress across an interface is the same
// from both sides (Cleary & Monaghan 1999, of conduction). Include it after the declaration of `params`.
#ifndef MIXED_VISCOSITY_GLSL
#define MIXED_VISCOSITY_GLSL
#include "shared/sph_params.h"

layout(constant_id = 8) const bool MIXED_VISCOSITY = false;

// A particle's viscosity, or friction, from its interaction (shared/sph_params.h); 0 where nobody asks, and of dust and the dead,
// who have no volume.
float viscosity_of(vec3 interaction)
{
    return MIXED_VISCOSITY && interaction.y > 0.0 ? interaction.z / (params.viscosity_scale * interaction.y) : 0.0;
}

// What makes the other one's viscosity the mean of both.
float mean_viscosity_ratio(float own, float other) { return own > 0.0 ? 2.0 * own / (own + other) : 0.0; }

#endif
