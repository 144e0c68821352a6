#version 460
#extension GL_GOOGLE_include_directive : require
// The search for the pieces of solids begins: each solid particle is a piece of its own, called by its id (shared/rigid.h).
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/rigid.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Label { uint label[]; };   // by id: a piece's name
layout(set = 0, binding = 4, scalar) writeonly buffer Pieces { Piece pieces[]; }; // by name

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count) {
        return;
    }
    label[id[i]] = particle_state(attributes[i]) == STATE_SOLID ? id[i] : NO_PIECE;
    pieces[id[i]] = Piece(0u, 0u);
}
