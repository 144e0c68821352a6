// Wind over sand. What the wind takes off a flat bed is Bagnold's flux over the length of a hop (Bagnold 1941), times what the
// slope does to its shear stress (Kroy, Sauermann & Herrmann 2002), where the wind sees the surface at all. A grain that it has
// taken hops: it flies through the wind's logarithmic profile until it comes down on the sand, and is solid again.
//
// Sand stands in columns, a spacing wide, that are seen from above. Where they fall off more steeply than its angle of repose, the
// top of a column slides to the lowest one beside it, a spacing at a time (as in Werner, "Eolian dunes", Geology 23, 1995): so a
// slope comes to rest at its angle, whatever the order in which grains arrive, and nothing has to be balanced on its neighbors.
//
// One particle stands for all the sand in its volume; the size of a grain is that of the sand.
#ifndef MELTPOINT_SHARED_WIND_H
#define MELTPOINT_SHARED_WIND_H
#include "sph_params.h"

SHARED_BEGIN

SHARED_CONSTANT float KARMAN = 0.4f;

// Shear stress over that on flat ground rises by so much a slope of 1 along the wind: A B = 3.2 x 0.25 of Kroy et al.; the other
// part of theirs, of the hill as a whole, needs a Fourier transform and is left out.
SHARED_CONSTANT float STRESS_OF_SLOPE = 0.8f;
SHARED_CONSTANT float STEEPEST_STRESS = 1.0f; // slope from which on it rises no further: sand is not so steep for long

// The wind leaves the ground at a crest and comes back six crest heights on (Kroy et al.: separation bubbles): the direction in
// which it sees the surface falls by so much.
SHARED_CONSTANT float REATTACHMENT_SLOPE = 1.0f / 6.0f;

// In spacings.
SHARED_CONSTANT int GROUND_REACH = 3;         // texels of a spacing on each side, to which the ground's plane is fitted
SHARED_CONSTANT float STEEPEST_STEP = 1.5f;   // between neighboring columns, of sand at any angle of repose: no towers
SHARED_CONSTANT float ANY_SLOPE = 1e30f;      // of the ground: nothing is too steep
SHARED_CONSTANT float GENTLE_SLOPE = 0.3f;    // of the ground: less never makes a step too steep by itself
SHARED_CONSTANT float LEAST_STEP = 0.9f;      // down which a grain slides: it is to end no higher than it was
SHARED_CONSTANT float HIGHEST_SLIDE = 2.5f;   // a grain that is to come down by more than so falls
SHARED_CONSTANT float EQUAL_STEP = 1e-3f;     // steps that differ by less are the same: the first of them is taken
SHARED_CONSTANT float HIGHEST_CLIMB = 1.0f;   // that a flying grain is beneath a column and still comes down on it

// Where a column's top goes, as one of its eight neighbors k % 3 - 1, k / 3 - 1 on the map.
SHARED_CONSTANT uint WAY_NONE = 4u;  // it stays
SHARED_CONSTANT uint WAY_TAKEN = 9u; // the wind has taken it
SHARED_CONSTANT uint WAY_FALLS = 16u; // added to the others: it falls there, instead of sliding

SHARED_CONSTANT float LEAST_LAUNCH = 0.7f;   // speed of the slowest over that of the mean; the fastest has as much more
SHARED_CONSTANT float FLYING_VOLUME = 0.06f; // that is seen of a particle while it hops: its sand is spread out

SHARED_CONSTANT float ROOM_TO_LAND = 0.85f; // spacings: sand that has come down waits while fluid is nearer to its place

struct WindMaterial {
    uint erodes;           // 1 of sand
    float pick_up;         // kg/(m^2 s), of a flat bed in full wind, were there no threshold
    float threshold;       // shear stress over that on flat ground, below which it takes nothing
    float steepest;        // tangent of the angle at which sand begins to slide
    float response_time;   // s, in which a grain takes on most of the air's velocity
    float launch_speed;    // m/s, upward, at which a mean hop begins
};

struct WindParams {
    vec3 direction;          // unit vectors: along the wind, at right angles to gravity,
    float friction_velocity; // u*, m/s
    vec3 up;                 // and against gravity
    float roughness_length;  // z0, m
    float floor_height;      // m, along up, of the lowest border
    WindMaterial of[MAX_MATERIALS];
};

struct WindPush {
    float seconds; // that the wind has blown since the last look
    float ahead;   // half of what passes until the next look, over what has passed since the last one
};

// What the slope along the wind does to the shear stress, over that on flat ground.
SHARED_FUNCTION float stress_on_slope(float slope)
{
    float s = slope < -STEEPEST_STRESS ? -STEEPEST_STRESS : (slope > STEEPEST_STRESS ? STEEPEST_STRESS : slope);
    return 1.0f + STRESS_OF_SLOPE * s;
}

// From 0 to 1, as random as an id is (Knuth's multiplicative hash).
SHARED_FUNCTION float random_share(uint id) { return float((id * 2654435769u) >> 8u) / 16777216.0f; }

// Which of eight equal ways a grain takes, 0 to 7: no side is preferred.
SHARED_FUNCTION uint first_way(uint id) { return id * 2654435769u >> 29u; }

// Of a hop, over that of a mean one.
SHARED_FUNCTION float launch_share(uint id)
{
    float share = random_share(id);
    return LEAST_LAUNCH + 2.0f * (1.0f - LEAST_LAUNCH) * share;
}

SHARED_END
#endif
