// Neighbors of a tile: TILE consecutive particles of the sorted order, owned by one invocation. Each candidate is loaded
// once for all of them. Software devices run eight invocations in step and take both sides of every branch: what is skipped
// there must be skipped by ending a loop. GPUs prefer tiles of 1.
//
// Before including: #define CELL_START_BINDING to the binding of the grid's cell starts.
#ifndef NEIGHBOR_WALK_GLSL
#define NEIGHBOR_WALK_GLSL
#include "include/grid.glsl"

layout(constant_id = 1) const uint TILE = 1;
layout(constant_id = 5) const bool STILL = false; // there are still particles, with a table of cells of their own

layout(set = 0, binding = CELL_START_BINDING, scalar) readonly buffer CellStart { uint cell_start[]; };

const vec3 NOWHERE = vec3(1e9); // out of everyone's reach

// A walk over the rows of cells around the positions of a tile: those of a position are 9 (y and z offsets -1, 0, 1; x
// offsets -2 .. 2), through the moving particles and then through the still ones. Every position meets its neighbors in
// ascending order, whatever the tile.
struct Walk {
    ivec2 cells;      // in the linear order, first cell of the row at offset 0 and the one after its last
    ivec2 low;        // y and z offsets of the rows to visit: low .. high
    ivec2 high;
    ivec2 offset;     // of the next row
    ivec3 size;       // of the grid
    int table;        // where the cell starts of those who are met begin
    uint visited_end; // the rows of a tile that spans cells may overlap: each starts where the one before ended
};

// Beyond so many cells along x a tile is long.
const int LONG_CELLS = 8;

Walk begin_walk(vec3 x[TILE], vec3 domain_min, float support_radius, uvec3 grid_size)
{
    ivec3 size = ivec3(grid_size);
    ivec3 low = ivec3(0x7fffffff); // the box of the cells that the positions lie in
    ivec3 high = ivec3(-0x7fffffff);
    ivec2 ends = ivec2(0x7fffffff, -0x7fffffff); // first and last of these cells in the linear order
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        bool is_there = x[k] != NOWHERE;
        ivec3 cell = cell_coordinates(x[k], domain_min, support_radius, grid_size);
        int index = cell_index(cell, grid_size);
        low = is_there ? min(low, cell) : low;
        high = is_there ? max(high, cell) : high;
        ends = is_there ? ivec2(min(ends.x, index), max(ends.y, index)) : ends;
    }
    bool is_empty = high.x < low.x;
    low = is_empty ? ivec3(0) : low;
    high = is_empty ? ivec3(0) : high;

    // A tile that goes on in the next row, or layer, walks through the linear order; one that lies in a row, or whose images
    // lie across two, through the rows of its box.
    ivec3 extent = high - low;
    int across = extent.y + extent.z;
    bool in_box = across == 0 || (across == 1 && extent.x <= LONG_CELLS);
    int reach = int(CELLS_PER_SUPPORT_X);
    Walk walk = Walk(ends + ivec2(-reach, reach + 1), ivec2(-1), ivec2(1), ivec2(0), size, 0, 0u);
    if (in_box) { // nothing beyond the ends of its rows, no rows outside of the grid
        int row = cell_index(ivec3(0, low.yz), grid_size);
        walk.cells = row + clamp(ivec2(low.x - reach, high.x + reach + 1), ivec2(0), ivec2(size.x));
        walk.low = max(walk.low, -low.yz);
        walk.high = min(extent.yz + 1, size.yz - 1 - low.yz);
    }
    walk.high = is_empty ? ivec2(-2) : walk.high;
    walk.offset = walk.low;
    return walk;
}

// Finds the next candidates, range.x .. range.y - 1 in the sorted order. False when there are no more.
bool next_range(inout Walk walk, out uvec2 range)
{
    bool found = all(lessThanEqual(walk.offset, walk.high));
    ivec2 cells = walk.cells + (walk.offset.y * walk.size.y + walk.offset.x) * walk.size.x;
    int cell_count = walk.size.x * walk.size.y * walk.size.z;
    cells = walk.table + clamp(cells, ivec2(0), ivec2(cell_count));
    range.x = max(cell_start[cells.x], walk.visited_end);
    range.y = max(cell_start[cells.y], range.x);
    walk.visited_end = range.y;
    bool next_layer = walk.offset.x == walk.high.x;
    walk.offset.x = next_layer ? walk.low.x : walk.offset.x + 1;
    walk.offset.y += next_layer ? 1 : 0;
    bool next_table = STILL && walk.table == 0 && walk.offset.y > walk.high.y;
    walk.offset = next_table ? walk.low : walk.offset;
    walk.table = next_table ? cell_count : walk.table;
    return found;
}

// A tile whose particles lie far apart would meet all that lies between them, in each row: beyond so many cells and
// candidates in one of them its particles walk one by one.
const uint WIDE_CANDIDATES = 32u * TILE;

bool is_wide(Walk walk)
{
    bool is_long = walk.cells.y - walk.cells.x > LONG_CELLS + 2 * int(CELLS_PER_SUPPORT_X) + 1;
    walk.high = is_long ? walk.high : ivec2(-2);
    uint most = 0u;
    for (uvec2 range; next_range(walk, range);) {
        most = max(most, range.y - range.x);
    }
    return is_long && most > WIDE_CANDIDATES;
}

// for every candidate range.x that the tile's positions may have as a neighbor
#define FOR_EACH_CANDIDATE(range, walk)                                                                               \
    for (uvec2 range; next_range(walk, range);)                                                                        \
        for (; range.x < range.y; ++range.x)

#endif
