#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Sand that the wind has taken, or that slides, moves by a step (shared/wind.h). A hop ends where it comes down, or runs into a
// slope: what speed it had goes into the bed. What is loose slides down the ground, held by Coulomb friction, and is pushed out
// of solid. What has left the domain is dead. Twin: engine/reference/wind.cpp.
#define CELL_START_BINDING 1
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "shared/emission.h"
#include "shared/particle_state.h"
#include "shared/sph_params.h"
#include "shared/visibility.h"
#include "shared/wind.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) uniform Wind { WindParams wind; };
layout(set = 0, binding = 3, scalar) uniform View { VisibilityParams view; };
layout(set = 0, binding = 4, scalar) readonly buffer GroundBuffer { vec4 ground[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 6, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 7, scalar) buffer Position { vec4 position[]; };
layout(set = 0, binding = 8) uniform textureBuffer position_texels; // of still ones, which nobody moves
layout(set = 0, binding = 9, scalar) buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 10, scalar) writeonly buffer Density { float density[]; }; // what is seen of it
layout(set = 0, binding = 11, scalar) writeonly buffer Rests { uint rests[]; };      // by id: 1 where it is loose and at rest
layout(set = 0, binding = 12, scalar) buffer LedgerBuffer { Ledger ledger; };

#include "include/ground.glsl"
#include "include/solid_around.glsl"

vec3 air_velocity(float above_ground)
{
    return wind.friction_velocity / KARMAN * log(max(above_ground / wind.roughness_length, 1.0)) * wind.direction;
}

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count || particle_state(attributes[i]) != STATE_DUST) {
        return;
    }
    uint cause = cause_of(attributes[i]);
    if (cause != CAUSE_WIND && cause != CAUSE_SLIDE) {
        return;
    }
    WindMaterial sand = wind.of[particle_material(attributes[i])];
    float d = params.spacing;
    vec3 x = position[i].xyz;
    vec3 v = velocity[i].xyz;
    bool hops = cause == CAUSE_WIND;
    if (hops) {
        float above = height_of(x) - ground_at(x).height - 0.5 * d;
        float taken_on = 1.0 - exp(-params.dt / sand.response_time);
        v += taken_on * (air_velocity(above) + sand.response_time * params.gravity - v);
    } else {
        v += params.dt * params.gravity;
    }
    x = wrapped(x + params.dt * v);
    // Walls hold back what is loose.
    vec3 low = mix(vec3(-NO_WALL), params.domain_min + 0.5 * d, notEqual(params.wall_mask & uvec3(1u, 4u, 16u), uvec3(0u)));
    vec3 high = mix(vec3(NO_WALL), params.domain_max - 0.5 * d, notEqual(params.wall_mask & uvec3(2u, 8u, 32u), uvec3(0u)));
    x = hops ? x : clamp(x, low, high);
    float under_floor = 0.5 * d - height_of(x);
    x += max(under_floor, 0.0) * wind.up;

    Ground below = ground_at(x);
    vec3 fall = hops ? vec3(0.0) : steepest_fall(x);
    vec3 n = normalize(wind.up - fall);
    vec2 around = solid_around(x);
    bool touches = under_floor >= 0.0 || around.y >= wind.rest_support;
    bool lands = hops && (height_of(x) < below.height - BURIED * d || (touches && dot(v, wind.up) < 0.0));
    v = lands ? vec3(0.0) : v;
    bool at_rest = false;
    if (!hops && touches) {
        float against = max(-dot(v, n), 0.0);
        v += against * n;
        vec3 along = v - dot(v, n) * n;
        float speed = length(along);
        v -= along * min(sand.friction * against / max(speed, 1e-30), 1.0);
        v *= min(wind.slide_speed / max(length(v), 1e-30), 1.0);
        at_rest = length(v) < wind.rest_speed && length(fall) < sand.friction;
    }
    bool crowded = around.x + wind.own_filling > 1.0;
    float push = max(min(around.y / wind.rest_support - 1.0, 1.0), crowded ? 1.0 : 0.0);
    x = hops ? x : clamp(wrapped(x + max(push, 0.0) * LONGEST_PUSH * d * n), low, high);

    bool inside = all(greaterThanEqual(x, params.domain_min)) && all(lessThanEqual(x, params.domain_max));
    position[i].xyz = inside ? x : position[i].xyz;
    velocity[i].xyz = v;
    density[i] = hops && !lands ? FLYING_VOLUME : 1.0;
    rests[id[i]] = at_rest && inside ? 1u : 0u;
    attributes[i] = lands ? freed_as(attributes[i], STATE_DUST, CAUSE_SLIDE) : attributes[i];
    if (!inside) {
        attributes[i] = with_state(attributes[i], STATE_DEAD);
        atomicAdd(ledger.sunk, 1u);
    }
}
