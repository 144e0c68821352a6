// What the host and the passes of the counting sort agree on.
#ifndef MELTPOINT_SHARED_COUNTING_SORT_H
#define MELTPOINT_SHARED_COUNTING_SORT_H
#include "prelude.h"

SHARED_BEGIN

// Up to this many elements of one key are ordered by counting, which costs their number squared; more go to a radix
// sort.
SHARED_CONSTANT uint CROWDED_KEY = 512u;

struct CountingSortParams {
    uint count;     // elements
    uint key_count; // keys are 0 .. key_count - 1
};

// Head of the list of crowded keys, and the arguments of the indirect dispatch that sorts them: one workgroup a key.
struct CrowdedKeys {
    uint count;
    uint workgroups_y; // 1
    uint workgroups_z; // 1
};

SHARED_END
#endif
