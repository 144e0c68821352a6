// Emitters put fluid into a scene that runs, sinks take it out. A particle that is to come is a dead one, a slot of its
// emitter: at a look the emitter's dead slots of smallest id are called up, each for a birth that is due before the
// next look, and wait at its place until their time. Births of an emitter are numbered: layer after layer of the points
// of a nozzle, or drop after drop at random places of a cloud.
#ifndef MELTPOINT_SHARED_EMISSION_H
#define MELTPOINT_SHARED_EMISSION_H
#include "prelude.h"

SHARED_BEGIN

SHARED_CONSTANT uint MAX_EMITTERS = 16u;
SHARED_CONSTANT uint MAX_SINKS = 16u;

// Spacings: no particle comes where another one is nearer. What flows off a nozzle freely is a spacing away by then.
SHARED_CONSTANT float BIRTH_DISTANCE = 0.85f;

struct Emitter {
    vec3 velocity;    // m/s
    float start;      // s, since the start of the run
    vec3 spread;      // m: each birth's place is its point plus this times random numbers in 0 .. 1
    float period;     // s, from one layer to the next
    float jitter;     // parts of a period that a birth may be late, at random
    uint first_point; // of a layer's points
    uint points;      // of a layer
    uint first_id;    // of its slots
    uint slots;
    uint births; // of all its time
    uint seed;
};

// One emitter's births that are called up at a look.
struct Call {
    uint emitter;
    uint first_birth; // number of the first
    uint births;      // how many
    uint first_dead;  // place in the pool from which on all are dead, in order of id
};

SHARED_CONSTANT uint SINK_BLOCK = 0u;
SHARED_CONSTANT uint SINK_SPHERE = 1u;

struct Sink {
    vec3 low; // m: lowest corner, or center
    uint shape;
    vec3 high; // m: highest corner; x: radius
    uint unused;
};

// What has come and gone since the start of the run.
struct Ledger {
    uint emitted;
    uint sunk; // into sinks, and dust at the end of its life or of the domain
};

// 32 bits that depend on two numbers in every bit (Jarzynski & Olano, "Hash Functions for GPU Rendering", JCGT 2020,
// pcg).
SHARED_FUNCTION uint random_bits(uint seed, uint number)
{
    uint state = (seed * 2654435769u + number) * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// In 0 .. 1, of a birth: `which` of its random numbers, 0 to 3.
SHARED_FUNCTION float birth_random(Emitter emitter, uint birth, uint which)
{
    return float(random_bits(emitter.seed + which, birth) >> 8u) / 16777216.0f;
}

// s, since the start of the run.
SHARED_FUNCTION float birth_time(Emitter emitter, uint birth)
{
    return emitter.start +
           emitter.period * (float(birth / emitter.points) + emitter.jitter * birth_random(emitter, birth, 3u));
}

SHARED_END
#endif
