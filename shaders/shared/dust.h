// Dust: what a solid crumbles into. It drifts with air that is not simulated: a wind and eddies that it carries along, a sum of
// random waves without divergence (Kraichnan, "Diffusion by a Random Velocity Field", Phys. Fluids 13, 1970). A particle follows
// the air as its drag lets it, shrinks, and is dead when its life is over or it has left the domain.
#ifndef MELTPOINT_SHARED_DUST_H
#define MELTPOINT_SHARED_DUST_H
#include "prelude.h"

SHARED_BEGIN

SHARED_CONSTANT uint AIR_WAVES = 24u;

// amplitude cos(number . (x - wind t) + frequency t + phase), amplitude perpendicular to number.
struct AirWave {
    vec3 amplitude;  // m/s
    float frequency; // 1/s
    vec3 number;     // 1/m
    float phase;
};

struct DustParams {
    vec3 wind;           // m/s
    float response_time; // s, in which dust has taken on most of the air's velocity
    float life;          // s, from when it is freed
    AirWave waves[AIR_WAVES];
};

SHARED_END
#endif
