// The preconditioner of viscosity solves.
#ifndef VISCOSITY_BLOCK_GLSL
#define VISCOSITY_BLOCK_GLSL
#include "shared/viscosity_solve.h"

vec3 precondition(ViscosityBlock block, vec3 r)
{
    return block.diagonal * r + block.off_diagonal.zxy * r.yzx + block.off_diagonal.yzx * r.zxy;
}

#endif
