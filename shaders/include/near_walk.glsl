// Particles that lie nearer to a place than a reach, which may be any, in one table of cells; along periodic axes also beyond the
// border. Include it after the declarations of `params`, `cell_start`, `position` and `position_texels`.
#ifndef NEAR_WALK_GLSL
#define NEAR_WALK_GLSL
#include "include/candidate.glsl"
#include "include/grid.glsl"
#include "include/periodic.glsl"

struct NearWalk {
    vec3 x;
    float reach;
    ivec3 low; // of the cells
    ivec3 high;
    int table; // where the cell starts of those who are met begin
    ivec2 row; // y and z of the next row
};

// Where the cell starts of the still particles begin; those of the moving ones begin at 0.
int still_table() { return int(params.grid_size.x * params.grid_size.y * params.grid_size.z); }

NearWalk near_walk(vec3 x, float reach, int table)
{
    ivec3 last = ivec3(params.grid_size) - 1;
    ivec3 low = cell_coordinates(x - reach, params.domain_min, params.support_radius, params.grid_size);
    ivec3 high = cell_coordinates(x + reach, params.domain_min, params.support_radius, params.grid_size);
    low = clamp(low, ivec3(0), last);
    return NearWalk(x, reach, low, clamp(high, ivec3(0), last), table, low.yz);
}

bool next_row(inout NearWalk walk, out uvec2 range)
{
    bool found = walk.row.y <= walk.high.z;
    int row = walk.table + cell_index(ivec3(0, min(walk.row, walk.high.yz)), params.grid_size);
    range = uvec2(cell_start[row + walk.low.x], cell_start[row + walk.high.x + 1]);
    bool ends = walk.row.x == walk.high.y;
    walk.row = ends ? ivec2(walk.low.y, walk.row.y + 1) : walk.row + ivec2(1, 0);
    return found;
}

// The next one from j on that is near; `end` where there is none. Those too far are passed over by a loop of their own, as software
// devices would take both sides of a branch.
uint next_near(NearWalk walk, uint j, uint end)
{
    while (j < end && distance(load_candidate(position, j).xyz, walk.x) >= walk.reach) {
        ++j;
    }
    return j;
}

#define FOR_EACH_NEAR(j, walk)                                                                                         \
    for (uvec2 range; next_row(walk, range);)                                                                          \
        for (uint j = next_near(walk, range.x, range.y); j < range.y; j = next_near(walk, j + 1u, range.y))

// The place itself, and, within reach of periodic borders, where it is as seen from the other side. A set of axes has a bit each.
uint shift_axes(vec3 x, float reach)
{
    bvec3 near = lessThan(min(x - params.domain_min, params.domain_max - x), vec3(reach));
    uvec3 axes = uvec3(near) * uvec3(periodic_axes());
    return axes.x | axes.y << 1u | axes.z << 2u;
}

vec3 shifted(vec3 x, uint axes)
{
    vec3 extent = params.domain_max - params.domain_min;
    bvec3 is_low = lessThan(x, params.domain_min + 0.5 * extent);
    vec3 along = vec3(uvec3(axes, axes >> 1u, axes >> 2u) & 1u);
    return x + along * mix(-extent, extent, is_low);
}

#define FOR_EACH_SHIFT(axes, all) for (uint axes = 0u, left = 1u; left != 0u; axes = (axes - (all)) & (all), left = axes)

#endif
