#version 460
#extension GL_GOOGLE_include_directive : require
// Fluid and dust that is in a sink is dead. Twin: engine/reference/emission.cpp.
#include "include/invocation.glsl"
#include "shared/emission.h"
#include "shared/particle_state.h"
#include "shared/sph_params.h"

layout(push_constant, scalar) uniform Push { uint sink_count; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Sinks { Sink sinks[]; };
layout(set = 0, binding = 2, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 3, scalar) buffer Position { vec4 position[]; };
layout(set = 0, binding = 4, scalar) buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 5, scalar) buffer LedgerBuffer { Ledger ledger; };

bool is_in(Sink sink, vec3 x)
{
    bool in_block = all(greaterThanEqual(x, sink.low)) && all(lessThanEqual(x, sink.high));
    return sink.shape == SINK_BLOCK ? in_block : distance(x, sink.low) <= sink.high.x;
}

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count) {
        return;
    }
    uint state = particle_state(attributes[i]);
    vec3 x = position[i].xyz;
    bool sinks_now = false;
    for (uint s = 0u; s < sink_count; ++s) {
        sinks_now = sinks_now || is_in(sinks[s], x);
    }
    if (sinks_now && (state == STATE_FLUID || state == STATE_DUST)) {
        attributes[i] = with_state(attributes[i], STATE_DEAD);
        position[i].w = 0.0;
        velocity[i].w = -abs(velocity[i].w);
        atomicAdd(ledger.sunk, 1u);
    }
}
