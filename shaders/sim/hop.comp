#version 460
#extension GL_GOOGLE_include_directive : require
// Sand that the wind has taken, or that falls off a slope, flies on by a step, through the wind's logarithmic profile, until it
// comes down: then it waits for the next look (alight.comp). A column that is much higher is in its way: it falls before it. So
// is a wall. What has left the domain where there is none is dead. Twin: engine/reference/wind.cpp.
#include "include/invocation.glsl"
#include "shared/emission.h"
#include "shared/particle_state.h"
#include "shared/sph_params.h"
#include "shared/visibility.h"
#include "shared/wind.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform Wind { WindParams wind; };
layout(set = 0, binding = 2, scalar) uniform View { VisibilityParams view; };
layout(set = 0, binding = 3, scalar) readonly buffer GroundBuffer { vec4 ground[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 5, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 6, scalar) buffer Position { vec4 position[]; };
layout(set = 0, binding = 7, scalar) buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer Density { float density[]; }; // what is seen of it
layout(set = 0, binding = 9, scalar) buffer Rests { uint rests[]; };                // by id: 1 where it has come down
layout(set = 0, binding = 10, scalar) buffer LedgerBuffer { Ledger ledger; };

#include "include/ground.glsl"

vec3 air_velocity(float above_ground)
{
    return wind.friction_velocity / KARMAN * log(max(above_ground / wind.roughness_length, 1.0)) * wind.direction;
}

const float ENDLESS = 1e30; // m

bvec3 walls_below() { return notEqual(uvec3(params.wall_mask) & uvec3(1u, 4u, 16u), uvec3(0u)); }
bvec3 walls_above() { return notEqual(uvec3(params.wall_mask) & uvec3(2u, 8u, 32u), uvec3(0u)); }

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count || !is_flying_sand(attributes[i]) || rests[id[i]] != 0u) {
        return;
    }
    WindMaterial sand = wind.of[particle_material(attributes[i])];
    float d = params.spacing;
    vec3 x = position[i].xyz;
    vec3 v = velocity[i].xyz;
    float above = height_of(x) - ground_at(texel_at(x)).height - 0.5 * d;
    float taken_on = 1.0 - exp(-params.dt / sand.response_time);
    v += taken_on * (air_velocity(above) + sand.response_time * params.gravity - v);

    vec3 next = wrapped(x + params.dt * v);
    next += max(0.5 * d - height_of(next), 0.0) * wind.up; // the floor is no way out
    bool blocked = ground_at(texel_at(next)).top > height_of(next) + HIGHEST_CLIMB * d;
    if (blocked) {
        v = dot(v, wind.up) * wind.up;
        next = x + params.dt * v;
    }
    vec3 within = clamp(next, mix(vec3(-ENDLESS), params.domain_min, walls_below()), mix(vec3(ENDLESS), params.domain_max, walls_above()));
    v = mix(v, vec3(0.0), notEqual(within, next));
    next = within;
    bool inside = all(greaterThanEqual(next, params.domain_min)) && all(lessThanEqual(next, params.domain_max));
    float lowest = ground_at(texel_at(next)).top + d;
    bool lands = inside && height_of(next) <= lowest && dot(v, wind.up) <= 0.0;
    next += lands ? (lowest - height_of(next)) * wind.up : vec3(0.0);

    position[i].xyz = inside ? next : x;
    velocity[i].xyz = lands ? vec3(0.0) : v;
    density[i] = lands ? 1.0 : FLYING_VOLUME;
    rests[id[i]] = lands ? 1u : 0u;
    if (!inside) {
        attributes[i] = with_state(attributes[i], STATE_DEAD);
        atomicAdd(ledger.sunk, 1u);
    }
}
