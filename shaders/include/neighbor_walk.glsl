// Neighbors of a tile: TILE consecutive particles of the sorted order, owned by one invocation. Each candidate is loaded
// once for all of them. On software devices, where loads are scalar gathers, TILE = 8 is fastest; GPUs prefer 1.
//
// Before including: #define CELL_START_BINDING to the binding of the grid's cell starts.
#ifndef NEIGHBOR_WALK_GLSL
#define NEIGHBOR_WALK_GLSL
#include "include/grid.glsl"

layout(constant_id = 1) const uint TILE = 1;

layout(set = 0, binding = CELL_START_BINDING, scalar) readonly buffer CellStart { uint cell_start[]; };

// A walk over the 9 rows of cells (y and z offsets -1, 0, 1; x offsets -2 .. 2) around the positions of a tile, which lie in
// the cells first .. last of the linear order.
struct Walk {
    int first;
    int last;
    ivec2 row;        // y and z cell of the first position
    bool one_row;     // all positions lie in that row
    uvec3 grid_size;
    uint visited_end; // the rows of a tile that spans cells may overlap: each starts where the one before ended
};

Walk empty_walk(uvec3 grid_size) { return Walk(0x7fffffff, -0x7fffffff, ivec2(0), true, grid_size, 0u); }

bool is_empty(Walk walk) { return walk.last < walk.first; }

void include_position(inout Walk walk, vec3 x, vec3 domain_min, float support_radius)
{
    ivec3 cell = cell_coordinates(x, domain_min, support_radius, walk.grid_size);
    bool first_one = is_empty(walk);
    walk.one_row = first_one || (walk.one_row && cell.yz == walk.row);
    walk.row = first_one ? cell.yz : walk.row;
    int index = cell_index(cell, walk.grid_size);
    walk.first = min(walk.first, index);
    walk.last = max(walk.last, index);
}

// The next row's candidates, begin and end in the sorted order. Cells beyond a row's end belong to the next row: some more
// candidates, which the distance test drops.
uvec2 next_row(int number, inout Walk walk)
{
    ivec2 step = ivec2(number % 3, number / 3) - 1;
    ivec2 row = walk.row + step;
    ivec3 size = ivec3(walk.grid_size);
    if (walk.one_row && (any(lessThan(row, ivec2(0))) || any(greaterThanEqual(row, size.yz)))) {
        return uvec2(0u);
    }
    int offset = cell_index(ivec3(0, step), walk.grid_size);
    int reach = int(CELLS_PER_SUPPORT_X);
    int cells = size.x * size.y * size.z;
    uint begin = max(cell_start[clamp(walk.first + offset - reach, 0, cells)], walk.visited_end);
    uint end = max(cell_start[clamp(walk.last + offset + reach + 1, 0, cells)], begin);
    walk.visited_end = end;
    return uvec2(begin, end);
}

// for every candidate range.x of the tile
#define FOR_EACH_CANDIDATE(range, walk)                                                                               \
    for (int row = 0; row < 9; ++row)                                                                                  \
        for (uvec2 range = next_row(row, walk); range.x < range.y; ++range.x)

#endif
