// Cells that hold somebody whose temperature is not the common one (shared/heat.h): a bit each, those of a row in words of 32.
// Include it after the declarations of `params` and `warm_cells`.
#ifndef WARM_CELLS_GLSL
#define WARM_CELLS_GLSL
#include "include/grid.glsl"
#include "shared/heat.h"

ivec3 cell_within(vec3 x)
{
    return clamp(cell_coordinates(x, params.domain_min, params.support_radius, params.grid_size), ivec3(0), ivec3(params.grid_size) - 1);
}

uint warm_row(ivec2 yz) { return uint(yz.y * int(params.grid_size.y) + yz.x) * warm_words(params.grid_size.x); }

#endif
