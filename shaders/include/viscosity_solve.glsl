// How an iteration of a viscosity solve ends. Include it after the declarations of `params` and of `viscosity`, the solve's state.
#ifndef VISCOSITY_SOLVE_GLSL
#define VISCOSITY_SOLVE_GLSL
#include "include/solve.glsl"
#include "include/viscosity_block.glsl"

// residual, change: sums of m r^2 and m u^2, u the change of velocity.
void end_viscosity_iteration(float residual, float change, uint iteration)
{
    float error = sqrt(residual) / (sqrt(change) + VISCOSITY_CHANGE_FLOOR * sqrt(viscosity.momentum) + 1e-30);
    bool met = error <= params.viscosity_error;
    bool ends = met || iteration >= params.viscosity_iterations;
    viscosity.solve.groups = ends ? uvec3(0u) : gl_NumWorkGroups;
    if (ends) {
        note_end(viscosity.solve, iteration, error, met);
    }
}

#endif
