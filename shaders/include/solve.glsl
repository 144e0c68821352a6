// What an iterative solve leaves where it ends.
#ifndef SOLVE_GLSL
#define SOLVE_GLSL
#include "shared/solve.h"

// met: whether it ended because its error did, not at the maximum of iterations.
void note_end(inout Solve solve, uint iterations, float error, bool met)
{
    solve.iterations = iterations;
    solve.error = error;
    solve.worst_error = max(solve.worst_error, error);
    solve.total_iterations += iterations;
    solve.unconverged += met ? 0u : 1u;
}

#endif
