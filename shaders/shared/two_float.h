// A number as the sum of two floats, x + y with |y| at most half an ulp of x: about 48 bits. For sums of many small terms: where
// a float has reached 334,000, its ulp is 0.03, and terms of a tenth of that are lost one and all.
#ifndef MELTPOINT_SHARED_TWO_FLOAT_H
#define MELTPOINT_SHARED_TWO_FLOAT_H
#include "prelude.h"

#ifdef __cplusplus
#define SHARED_PRECISE
#else
#define SHARED_PRECISE precise // or a compiler might find that the rounding errors below are zero
#endif

SHARED_BEGIN

// a + term: the exact sum of the large parts is sum + error (Knuth, The Art of Computer Programming 2, 4.2.2, theorem B), and
// what comes of both small parts is brought back into shape (Dekker 1971).
SHARED_FUNCTION vec2 two_float_add(vec2 a, float term)
{
    SHARED_PRECISE float sum = a.x + term;
    SHARED_PRECISE float part = sum - a.x;
    SHARED_PRECISE float error = (a.x - (sum - part)) + (term - part);
    SHARED_PRECISE float small = a.y + error;
    SHARED_PRECISE float large = sum + small;
    SHARED_PRECISE float rest = small - (large - sum);
    return vec2(large, rest);
}

SHARED_END
#endif
