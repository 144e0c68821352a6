// What fluid does to a boundary particle: the force of each pair, turned around.
#ifndef MELTPOINT_SHARED_REACTION_H
#define MELTPOINT_SHARED_REACTION_H
#include "prelude.h"

SHARED_BEGIN

// Integrals over time of the forces on one boundary particle, since the host last asked.
struct Reaction {
    vec3 pressure; // N s
    vec3 friction; // N s
};

struct ReactionPush {
    uint first_id; // of boundary particles: theirs is the reaction number 0
    uint count;    // of particles in the sorted order, those to be looked at
};

SHARED_END
#endif
