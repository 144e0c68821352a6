#version 460
#extension GL_GOOGLE_include_directive : require
// Births: those whose time has come and whose place is free are fluid from now on; those whose place is not are dead again.
// birth_place.comp has looked. Twin: engine/reference/emission.cpp.
#include "include/invocation.glsl"
#include "shared/emission.h"
#include "shared/particle_state.h"
#include "shared/sph_params.h"
#include "shared/time_step.h"

layout(push_constant, scalar) uniform Push { float start; }; // s: the time when step.elapsed was 0
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Step { TimeStep step; };
layout(set = 0, binding = 2, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 3, scalar) readonly buffer ReleaseTime { float release_time[]; }; // by id, s
layout(set = 0, binding = 4, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 5, scalar) buffer Position { vec4 position[]; };
layout(set = 0, binding = 6, scalar) buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 7, scalar) buffer Density { float density[]; };
layout(set = 0, binding = 8, scalar) buffer LedgerBuffer { Ledger ledger; };

#include "include/birth.glsl"

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count || (attributes[i] & FLAG_DUE) == 0u || density[i] < 0.0) {
        return;
    }
    uint called = attributes[i] & ~FLAG_DUE;
    if (density[i] > 0.0) {
        float time = start + step.elapsed;
        position[i] = vec4(birth_position(position[i].xyz, velocity[i].xyz, release_time[id[i]], time), 1.0);
        velocity[i].w = abs(velocity[i].w);
        called = with_state(called, STATE_FLUID);
        atomicAdd(ledger.emitted, 1u);
    }
    attributes[i] = called;
    density[i] = 0.0;
}
