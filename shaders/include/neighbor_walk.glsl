// Neighbors of a tile: TILE consecutive particles of the sorted order, owned by one invocation. Each candidate is loaded
// once for all of them. Software devices run eight invocations in step and take both sides of every branch: what is skipped
// there must be skipped by ending a loop. GPUs prefer tiles of 1.
//
// Before including: #define CELL_START_BINDING to the binding of the grid's cell starts.
#ifndef NEIGHBOR_WALK_GLSL
#define NEIGHBOR_WALK_GLSL
#include "include/grid.glsl"

layout(constant_id = 1) const uint TILE = 1;

layout(set = 0, binding = CELL_START_BINDING, scalar) readonly buffer CellStart { uint cell_start[]; };

const vec3 NOWHERE = vec3(1e9); // out of everyone's reach

// A tile whose particles lie far apart would meet all that lies between them, in each row: beyond so many cells and
// candidates a row its particles walk one by one.
const int WIDE_CELLS = 8;
const uint WIDE_CANDIDATES = 32u * TILE;
const int TOGETHER = -1;

// A walk over the 9 rows of cells (y and z offsets -1, 0, 1; x offsets -2 .. 2) around the positions of a tile, which lie in
// the cells first .. last of the linear order. Every position meets its neighbors in ascending order, whatever the tile.
struct Walk {
    uvec3 grid_size;
    vec3 domain_min;
    float support_radius;
    int first;
    int last;
    ivec2 row;        // y and z cell of the first position
    bool one_row;     // all positions lie in that row
    ivec2 low;        // y and z offsets of the rows to visit: low .. high; in one row those inside the grid
    ivec2 high;
    ivec2 offset;     // of the next row
    int particle;     // of the tile, that walks next; or TOGETHER
    uint visited_end; // the rows of a tile that spans cells may overlap: each starts where the one before ended
};

// `present` are the positions that meet the next candidates: at first all.
Walk begin_walk(vec3 x[TILE], out vec3 present[TILE], vec3 domain_min, float support_radius, uvec3 grid_size)
{
    Walk walk = Walk(grid_size, domain_min, support_radius, 0x7fffffff, -0x7fffffff, ivec2(0), true, ivec2(-1), ivec2(1),
                     ivec2(0), TOGETHER, 0u);
    bool is_empty = true;
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        present[k] = x[k];
        bool is_there = x[k] != NOWHERE;
        ivec3 cell = cell_coordinates(x[k], domain_min, support_radius, grid_size);
        int index = cell_index(cell, grid_size);
        walk.first = is_there ? min(walk.first, index) : walk.first;
        walk.last = is_there ? max(walk.last, index) : walk.last;
        walk.one_row = walk.one_row && (!is_there || is_empty || cell.yz == walk.row);
        walk.row = is_there && is_empty ? cell.yz : walk.row;
        is_empty = is_empty && !is_there;
    }
    if (walk.one_row) {
        walk.low = max(walk.low, -walk.row);
        walk.high = min(walk.high, ivec2(grid_size.yz) - 1 - walk.row);
    }
    walk.high = is_empty ? ivec2(-2) : walk.high;
    walk.offset = walk.low;
    return walk;
}

// The first and the last-but-one cell that a row of the walk looks into, in the linear order.
ivec2 cells_together(Walk walk)
{
    int reach = int(CELLS_PER_SUPPORT_X);
    int offset = cell_index(ivec3(0, walk.offset), walk.grid_size);
    ivec2 cells = ivec2(walk.first - reach, walk.last + reach + 1) + offset;
    int row = cell_index(ivec3(0, walk.row + walk.offset), walk.grid_size);
    return walk.one_row ? clamp(cells, ivec2(row), ivec2(row + int(walk.grid_size.x))) : cells;
}

// Likewise for one position. Empty where the position is nowhere or the row outside of the grid.
ivec2 cells_alone(Walk walk, vec3 x)
{
    int reach = int(CELLS_PER_SUPPORT_X);
    ivec3 cell = cell_coordinates(x, walk.domain_min, walk.support_radius, walk.grid_size);
    ivec2 row = cell.yz + walk.offset;
    bool is_there = x != NOWHERE && all(greaterThanEqual(row, ivec2(0))) && all(lessThan(row, ivec2(walk.grid_size.yz)));
    ivec2 cells = clamp(cell.x + ivec2(-reach, reach + 1), ivec2(0), ivec2(walk.grid_size.x));
    return is_there ? cells + cell_index(ivec3(0, row), walk.grid_size) : ivec2(0);
}

// Finds the next candidates, range.x .. range.y - 1 in the sorted order, and which of the positions x meet them: `present`
// holds these, NOWHERE for the others. False when there are no more.
bool next_range(inout Walk walk, vec3 x[TILE], inout vec3 present[TILE], out uvec2 range)
{
    bool found = all(lessThanEqual(walk.offset, walk.high));
    ivec2 cells = cells_together(walk);
    bool together = TILE == 1u || walk.particle == TOGETHER;
    if (TILE > 1u) {
        vec3 alone = x[0];
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            alone = walk.particle == int(k) ? x[k] : alone;
            present[k] = together ? present[k] : (walk.particle == int(k) ? x[k] : NOWHERE);
        }
        ivec2 its_cells = cells_alone(walk, alone);
        cells = together ? cells : its_cells;
    }
    ivec3 size = ivec3(walk.grid_size);
    cells = clamp(cells, ivec2(0), ivec2(size.x * size.y * size.z));
    range.x = max(cell_start[cells.x], walk.visited_end);
    range.y = max(cell_start[cells.y], range.x);

    bool is_wide = TILE > 1u && together && walk.last - walk.first > WIDE_CELLS && range.y - range.x > WIDE_CANDIDATES;
    range.y = is_wide ? range.x : range.y;
    walk.visited_end = together && !is_wide ? range.y : walk.visited_end;
    bool next_row = together ? !is_wide : walk.particle + 1 == int(TILE);
    walk.particle = is_wide || (!together && next_row) ? 0 : walk.particle + (together ? 0 : 1);
    bool next_layer = next_row && walk.offset.x == walk.high.x;
    walk.offset.x = next_layer ? walk.low.x : walk.offset.x + (next_row ? 1 : 0);
    walk.offset.y += next_layer ? 1 : 0;
    return found;
}

// for every candidate range.x that the positions present[] may have as a neighbor
#define FOR_EACH_CANDIDATE(range, walk, x, present)                                                                   \
    for (uvec2 range; next_range(walk, x, present, range);)                                                            \
        for (; range.x < range.y; ++range.x)

#endif
