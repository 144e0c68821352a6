// Hydraulic erosion: flow along the surface of a solid carries it off (Kristof, Benes, Krivanek & Stava, "Hydraulic Erosion
// Using Smoothed Particle Hydrodynamics", Computer Graphics Forum 28, 2009, after Wojtan, Carlson, Mucha & Turk 2007).
//
// A solid particle's surface, of normal n and area A (shared/exposure.h), feels the flow a spacing d off it: v is the mean
// velocity of the fluid there. The part of v along the surface shears at theta = |v - (v.n) n| / d: finer particles see a thinner
// layer of fluid, and so more shear. Its stress is that of a power law, and beyond a threshold the solid loses mass:
//     tau = K theta^n,    eps = K_eps (tau / s - tau_c)^a    in kg/(m^2 s),
// where s is the particle's strength, 1 of what is usual. Damage D grows from 0, sound, by dD/dt = eps A / (s m), times a scale
// of time; at 1 the particle is free: fluid of its own material, so that sediment takes up its own volume and sinks. It is looked at
// now and then, and freed at the look that is nearest to its time.
//
// Sediment that is slow and rests on a solid, or on the floor, heals, D falling to 0 in the deposition time; whatever moves it
// on meanwhile brings it back to 1. At 0 it is solid again. D is kept by id as a two-float (shared/two_float.h).
#ifndef MELTPOINT_SHARED_HYDRAULIC_H
#define MELTPOINT_SHARED_HYDRAULIC_H
#include "sph_params.h"

SHARED_BEGIN

// Spacings: sediment rests on what is so near below it, no farther from the vertical than this cosine says. Steeper flanks shed.
SHARED_CONSTANT float RESTING_DISTANCE = 1.5f;
SHARED_CONSTANT float RESTING_COSINE = 0.7f;

// Density over that at rest, from which on sediment stays fluid: as a solid that lies too near to others it would squeeze out whoever
// comes free there next.
SHARED_CONSTANT float MOST_CROWDED = 1.05f;

struct HydraulicParams {
    float consistency;      // K, Pa s^n
    float flow_exponent;    // n
    float time_scale;       // seconds of erosion in one of motion
    float deposition_speed; // m/s: sediment is at rest below it
    float deposition_time;  // s, of motion
    uint erodes[MAX_MATERIALS];     // 1 where flow carries the solid off
    uint deposits[MAX_MATERIALS];   // 1 where its sediment becomes solid again
    float threshold[MAX_MATERIALS]; // tau_c, Pa
    float rate[MAX_MATERIALS];      // K_eps, kg/(m^2 s Pa^a)
    float exponent[MAX_MATERIALS];  // a
};

struct DetachPush {
    float time;  // s
    float ahead; // s: half of what passes until the next look
};

SHARED_END
#endif
