// How many particles change sides between the moving and the still ones.
#ifndef MELTPOINT_SHARED_POOL_CHANGES_H
#define MELTPOINT_SHARED_POOL_CHANGES_H
#include "prelude.h"

SHARED_BEGIN

struct PoolChanges {
    uint freed; // still ones that will move
    uint died;  // moving ones that are dead
};

SHARED_END
#endif
