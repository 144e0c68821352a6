#version 460
#extension GL_GOOGLE_include_directive : require
// Dust drifts for a step (shared/dust.h): its velocity nears that of the air, what is left of it goes to `density`, for the
// picture, and at the end of its life, or of the domain, it is dead. Twin: engine/reference/dust.cpp.
#include "include/invocation.glsl"
#include "shared/dust.h"
#include "shared/emission.h"
#include "shared/particle_state.h"
#include "shared/sph_params.h"
#include "shared/time_step.h"

layout(push_constant, scalar) uniform Push { float start; }; // s: the time when step.elapsed was 0
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform Dust { DustParams dust; };
layout(set = 0, binding = 2, scalar) readonly buffer Step { TimeStep step; };
layout(set = 0, binding = 3, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 4, scalar) readonly buffer ReleaseTime { float release_time[]; }; // by id, s
layout(set = 0, binding = 5, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 6, scalar) buffer Position { vec4 position[]; };
layout(set = 0, binding = 7, scalar) buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer Density { float density[]; };
layout(set = 0, binding = 9, scalar) buffer LedgerBuffer { Ledger ledger; };

#include "include/periodic.glsl"

vec3 air_velocity(vec3 x, float time)
{
    vec3 v = dust.wind;
    vec3 carried = x - dust.wind * time;
    for (uint k = 0u; k < AIR_WAVES; ++k) {
        AirWave wave = dust.waves[k];
        v += wave.amplitude * cos(dot(wave.number, carried) + wave.frequency * time + wave.phase);
    }
    return v;
}

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count || !is_drifting(attributes[i])) {
        return;
    }
    float time = start + step.elapsed;
    vec3 x = position[i].xyz;
    vec3 v = velocity[i].xyz;
    v += (1.0 - exp(-params.dt / dust.response_time)) * (air_velocity(x, time) - v);
    x = wrapped(x + params.dt * v);
    float left = 1.0 - (time - release_time[id[i]]) / dust.life;
    bool inside = all(greaterThanEqual(x, params.domain_min)) && all(lessThanEqual(x, params.domain_max));
    velocity[i].xyz = v;
    position[i].xyz = inside ? x : position[i].xyz;
    density[i] = clamp(left, 0.0, 1.0);
    if (!(inside && left > 0.0)) {
        attributes[i] = with_state(attributes[i], STATE_DEAD);
        atomicAdd(ledger.sunk, 1u);
    }
}
