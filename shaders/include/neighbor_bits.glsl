// Which candidates are neighbors, found once a step (density.comp) for every pass after it: a word for each chunk of 32
// candidates of a tile's walks, with a bit for each that lies within the support of one of the tile's positions. What lies
// beyond it adds exact zeros, so the bits change no result, only the time. A tile whose words are all taken meets the candidates
// of its further chunks one and all.
//
// Before including: #define NEIGHBOR_BITS_BINDING to the binding of the words, and in the pass that finds the neighbors
// FINDS_NEIGHBORS. All others must walk as that one did: without_boundary(load_tile()), and positions not moved since.
#ifndef NEIGHBOR_BITS_GLSL
#define NEIGHBOR_BITS_GLSL
#include "include/image_walk.glsl"

#ifdef FINDS_NEIGHBORS
#define NEIGHBOR_BITS_ACCESS writeonly
#else
#define NEIGHBOR_BITS_ACCESS readonly
#endif
layout(set = 0, binding = NEIGHBOR_BITS_BINDING, scalar) NEIGHBOR_BITS_ACCESS buffer NeighborBits { uint neighbor_bits[]; };

const uint CHUNK = 32u;

// Candidates first .. end - 1 of a row that ends at row_end, and where their word is.
struct Chunk {
    uint first;
    uint end;
    uint row_end;
    uint word;
};

const Chunk NO_CHUNK = Chunk(0u, 0u, 0u, 0u);

// The next chunk of the row, or the first of the next row; false, and an empty one, when there are no more. The words of neighboring tiles lie
// side by side.
bool next_chunk(inout Tile tile, inout Walk walk, inout Chunk chunk)
{
    bool found = true;
    uvec2 rest = uvec2(chunk.end, chunk.row_end);
    if (rest.x == rest.y) {
        found = next_range(walk, rest);
    }
    rest = found ? rest : uvec2(0u);
    chunk = Chunk(rest.x, min(rest.x + CHUNK, rest.y), rest.y, tile.next_word);
    tile.next_word += found ? (params.moving_count + TILE - 1u) / TILE : 0u;
    return found;
}

#ifdef FINDS_NEIGHBORS
// Finds them, around the positions x, and keeps their bits where there is a word for them. They are found a rounding error
// beyond the support, too: nothing may be left out that a pass gives more than zero.
uint neighbors(Chunk chunk, vec3 x[TILE])
{
    float reach2 = params.support_radius * params.support_radius * (1.0 + 1e-6);
    uint bits = 0u;
    uint bit = 1u;
    for (uint j = chunk.first; j < chunk.end; ++j) {
        vec3 xj = load_candidate(position, j).xyz;
        float nearest2 = NO_WALL;
        [[unroll]] for (uint k = 0u; k < TILE; ++k) {
            vec3 offset = x[k] - xj;
            nearest2 = min(nearest2, dot(offset, offset));
        }
        bits |= nearest2 <= reach2 ? bit : 0u;
        bit <<= 1u;
    }
    if (chunk.word < neighbor_bits.length()) {
        neighbor_bits[chunk.word] = bits;
    }
    return bits;
}
#else
uint neighbors(Chunk chunk, vec3 x[TILE])
{
    if (chunk.word < neighbor_bits.length()) {
        return neighbor_bits[chunk.word];
    }
    return chunk.first < chunk.end ? ~0u >> (CHUNK - (chunk.end - chunk.first)) : 0u;
}
#endif

// Two chunks whose neighbors are met in one loop: invocations that run in step wait for the one with the most neighbors in each
// loop, and two chunks together differ less than each for itself.
struct Chunks {
    Chunk last;     // the second one
    uint first;     // of the candidates that `bits` are of
    uint bits;      // neighbors that are left of the first chunk, then of the second
    uint last_bits; // those of the second one until then
};

const Chunks NO_CHUNKS = Chunks(NO_CHUNK, 0u, 0u, 0u);

// bits, or those of the second chunk where there are no more.
uint turn_over(inout Chunks chunks, uint bits)
{
    bool none = bits == 0u;
    chunks.first = none ? chunks.last.first : chunks.first;
    bits = none ? chunks.last_bits : bits;
    chunks.last_bits = none ? 0u : chunks.last_bits;
    return bits;
}

bool next_chunks(inout Tile tile, inout Walk walk, vec3 x[TILE], inout Chunks chunks)
{
    bool found = next_chunk(tile, walk, chunks.last);
    chunks.first = chunks.last.first;
    uint bits = found ? neighbors(chunks.last, x) : 0u;
    bool both = next_chunk(tile, walk, chunks.last);
    chunks.last_bits = both ? neighbors(chunks.last, x) : 0u;
    chunks.bits = turn_over(chunks, bits);
    return found;
}

// for every candidate chunks.first + findLSB(bits) that is a neighbor of one of the positions x, in ascending order
#define FOR_EACH_NEIGHBOR(tile, walk, x, chunks, bits)                                                                \
    for (Chunks chunks = NO_CHUNKS; next_chunks(tile, walk, x, chunks);)                                               \
        for (uint bits = chunks.bits; bits != 0u; bits = turn_over(chunks, bits & (bits - 1u)))

#endif
