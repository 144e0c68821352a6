// What is brought into the order of a sort.
#ifndef MELTPOINT_SHARED_GATHER_H
#define MELTPOINT_SHARED_GATHER_H
#include "prelude.h"

SHARED_BEGIN

struct GatherPush {
    uint count; // elements
    uint words; // of 32 bits, of each
};

SHARED_END
#endif
