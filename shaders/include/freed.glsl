// Counts a solid particle that is freed. Include it after the declarations of `params` and `changes`.
#ifndef FREED_GLSL
#define FREED_GLSL
#include "shared/pool_changes.h"

// Loose ones are among the moving already.
void count_freed(uint i)
{
    if (i < params.moving_count) {
        atomicAdd(changes.freed_loose, 1u);
    } else {
        atomicAdd(changes.freed, 1u);
    }
}

#endif
