// What sim/count_neighbors.comp finds out about a particle's neighbors: the other particles nearer than the support radius.
#ifndef MELTPOINT_SHARED_NEIGHBOR_COUNT_H
#define MELTPOINT_SHARED_NEIGHBOR_COUNT_H
#include "prelude.h"

SHARED_BEGIN

struct NeighborCount {
    uint neighbors;  // without the particle itself and without images in walls; across periodic borders
    uint id_sum;     // of their ids, modulo 2^32: with the count, a fingerprint of the set
    uint coincident; // those so near that the pair has no direction
};

SHARED_END
#endif
