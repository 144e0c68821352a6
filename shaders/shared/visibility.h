// What of a scene is seen along a direction, by the sun or by the wind: an orthographic depth map (Williams 1978). Each texel
// has the smallest depth, quantized, of the particles whose discs, at right angles to the direction, cover its center.
//
// A point x on a surface with the normal n is looked for at x + 2 d n: so the second layer of particles, which has 22 % of the
// exposed area, is not in the shadow of the first. It is seen as far as the four texels around it are no nearer than the plane
// through it at right angles to n (percentage closer filtering, Reeves, Salesin & Cook 1987): so a slanting face is not in its
// own shadow either, and no other bias is needed.
#ifndef MELTPOINT_SHARED_VISIBILITY_H
#define MELTPOINT_SHARED_VISIBILITY_H
#include "prelude.h"

SHARED_BEGIN

SHARED_CONSTANT uint DEPTH_STEPS = 1u << 24u;    // of the map's depth: as many as floats can count
SHARED_CONSTANT uint NOTHING_SEEN = 0xffffffffu; // the depth of an empty texel: behind all others

// In spacings.
SHARED_CONSTANT float CASTER_RADIUS = 0.71f;    // of a particle's disc: just more than half the diagonal of a lattice cell
SHARED_CONSTANT float RECEIVER_DISTANCE = 2.0f; // of the point that is looked for from its particle

SHARED_CONSTANT float LEAST_INCIDENCE = 0.17f; // cosine of the angle up to which that plane slants: 80 degrees

struct VisibilityParams {
    vec3 origin;       // m, of the map: the corner of its first texel, where the depth is 0
    float texel;       // m, side of a texel
    vec3 right;        // unit vectors: along the map's rows,
    float depth_scale; // 1/m, steps of depth
    vec3 up;           // across them,
    float spacing;     // d, m
    vec3 direction;    // and from the light, or with the wind, into the scene
    uint casters;      // states of the particles that hide others: the bits 1 << STATE_*
    uint width;        // texels; texel (x, y) is at y * width + x
    uint height;
};

SHARED_END
#endif
