// Melting: what sun and air give to the bare surface of solids, and who turns into fluid for it (shared/heat.h). A solid melts
// where its latent heat is complete, H >= L, at the look that is nearest to that time; fluid freezes where none of it is left,
// H <= 0, and a solid is there to freeze to.
#ifndef MELTPOINT_SHARED_MELTING_H
#define MELTPOINT_SHARED_MELTING_H
#include "sph_params.h"

SHARED_BEGIN

// Spacings: fluid freezes to solids that are so near.
SHARED_CONSTANT float FREEZING_DISTANCE = 1.5f;

struct MeltingParams {
    vec3 sun_direction;    // that its light travels in, of length 1
    float sun;             // W/m^2
    float air_temperature; // degrees C
    float air_transfer;    // W/(m^2 K)
    float absorptivity[MAX_MATERIALS];
    uint melts[MAX_MATERIALS];           // 1 where the solid melts
    float birth_enthalpy[MAX_MATERIALS]; // J/kg, of what emitters bring
};

struct MeltPush {
    float time;  // s
    float ahead; // half of what passes until the next look, over what has passed since the last one
};

// What is left on average, over x time constants, of a difference that decays: (1 - exp(-x)) / x. A look may be long for the air.
SHARED_FUNCTION float mean_decay(float x, float exp_of_minus_x)
{
    return x > 1e-3f ? (1.0f - exp_of_minus_x) / x : 1.0f - 0.5f * x;
}

SHARED_END
#endif
