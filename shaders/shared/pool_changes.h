// How many particles change sides between the moving and the still ones.
#ifndef MELTPOINT_SHARED_POOL_CHANGES_H
#define MELTPOINT_SHARED_POOL_CHANGES_H
#include "emission.h"
#include "sph_params.h"

SHARED_BEGIN

struct PoolChanges {
    uint freed; // still ones that will move
    uint freed_loose;  // loose solids that are solid no more: they move already
    uint frozen_loose; // moving ones that are solid, and loose: they go on moving
    uint died;   // moving ones that are dead
    uint frozen; // moving ones that are solid
    uint deposited; // moving ones that are solid, of sediment or sand at rest
    uint slid;      // still ones that are elsewhere
    uint picked_up[MAX_MATERIALS]; // of those freed, sand that the wind has taken, by material
    uint called[MAX_EMITTERS]; // dead ones that were called up to be born, by emitter
};

SHARED_END
#endif
