#version 460
#extension GL_GOOGLE_include_directive : require
// What becomes of pieces that nothing holds: they are loose from now on, or fall to fluid or dust where they are too small. Those
// who were still lie among the still ones yet. Twin: engine/reference/fragments.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/rigid.h"

layout(push_constant, scalar) uniform Push { float time; }; // s
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Label { uint label[]; };   // by id
layout(set = 0, binding = 3, scalar) readonly buffer Pieces { Piece pieces[]; }; // by name
layout(set = 0, binding = 4, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 5, scalar) buffer Position { vec4 position[]; }; // w: weight
layout(set = 0, binding = 6, scalar) buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 7, scalar) writeonly buffer ReleaseTime { float release_time[]; }; // by id, s
layout(set = 0, binding = 8, scalar) buffer Changes { PieceChanges changes; };

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count || particle_state(attributes[i]) != STATE_SOLID) {
        return;
    }
    Piece piece = pieces[label[id[i]]];
    if (piece.held != 0u) {
        return;
    }
    bool was_loose = is_loose(attributes[i]);
    if (piece.size < LEAST_PIECE) {
        bool crumbles = (attributes[i] & FLAG_CRUMBLES) != 0u;
        attributes[i] = freed_as(attributes[i], crumbles ? STATE_DUST : STATE_FLUID, CAUSE_FRAGMENT);
        velocity[i].w = crumbles ? velocity[i].w : abs(velocity[i].w);
        position[i].w = crumbles ? 0.0 : position[i].w;
        release_time[id[i]] = time;
        if (was_loose) {
            atomicAdd(changes.crumbled_loose, 1u);
        } else {
            atomicAdd(changes.crumbled, 1u);
        }
    } else if (!was_loose) {
        attributes[i] |= FLAG_LOOSE;
        atomicAdd(changes.loosened, 1u);
    }
}
