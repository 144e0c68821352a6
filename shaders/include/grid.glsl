// Cells of the neighbor grid: half a support radius long in x, one in y and z (shared/sph_params.h).
#ifndef GRID_GLSL
#define GRID_GLSL
#include "shared/sph_params.h"

// The cell of a position, also of one beyond the domain. NaN falls somewhere near: never far out of bounds.
ivec3 cell_coordinates(vec3 x, vec3 domain_min, float support_radius, uvec3 grid_size)
{
    vec3 cell_size = vec3(support_radius / float(CELLS_PER_SUPPORT_X), support_radius, support_radius);
    ivec3 limit = ivec3(grid_size) + 4;
    return clamp(ivec3(clamp(floor((x - domain_min) / cell_size), vec3(-4.0), vec3(limit))), ivec3(-4), limit);
}

int cell_index(ivec3 cell, uvec3 grid_size) { return (cell.z * int(grid_size.y) + cell.y) * int(grid_size.x) + cell.x; }

// The cell that a particle is sorted into. One beyond the domain, which the drift has reported, is kept in a cell of the border.
uint cell_of(vec3 x, vec3 domain_min, float support_radius, uvec3 grid_size)
{
    ivec3 cell = cell_coordinates(x, domain_min, support_radius, grid_size);
    return uint(cell_index(clamp(cell, ivec3(0), ivec3(grid_size) - 1), grid_size));
}

#endif
