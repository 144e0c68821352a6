// Which particles of a tile are boundary particles. Include it after the declaration of `attributes`.
#ifndef BOUNDARY_GLSL
#define BOUNDARY_GLSL
#include "include/image_walk.glsl"
#include "shared/particle_state.h"

uint count_boundary(Tile tile)
{
    uint count = 0u;
    for (uint i = tile.first; i <= tile.last; ++i) {
        count += is_boundary(attributes[i]) ? 1u : 0u;
    }
    return count;
}

// The tile; where it has nothing but boundary particles, whose density and acceleration nobody needs, without images to walk.
Tile without_boundary(Tile tile)
{
    tile.images = count_boundary(tile) == tile.last - tile.first + 1u ? 0u : tile.images;
    return tile;
}

// The tile; where it has no boundary particles, whose reaction alone is wanted, without images to walk.
Tile only_boundary(Tile tile)
{
    tile.images = count_boundary(tile) == 0u ? 0u : tile.images;
    return tile;
}

#endif
