#version 460
#extension GL_GOOGLE_include_directive : require
// Where loose particles lie, by id, and what each of them touches: anchored solids, colliders, and the particles of other bodies. It
// is a plane through their mean place, weighted by nearness, across the way from there to the particle: smooth where they are not
// (a point set surface, after Adamson & Alexa, "Approximating and Intersecting Surfaces from Points", SGP 2003). Twin:
// engine/reference/fragments.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/rigid.h"

layout(push_constant, scalar) uniform Push { uint body_count; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer CellStart { uint cell_start[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Position { vec4 position[]; }; // w: weight
layout(set = 0, binding = 5) uniform textureBuffer position_texels;
layout(set = 0, binding = 6, scalar) readonly buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 7) uniform textureBuffer velocity_texels;
layout(set = 0, binding = 8, scalar) readonly buffer BodyOf { uint body_of[]; }; // by id
layout(set = 0, binding = 9, scalar) readonly buffer Bodies { Body bodies[]; };
layout(set = 0, binding = 10, scalar) writeonly buffer Place { uint place[]; };    // by id
layout(set = 0, binding = 11, scalar) writeonly buffer Touches { Touch touches[]; }; // by id

#include "include/near_walk.glsl"

// Weighted sums over who is touched.
struct Near {
    vec3 offset;   // from them to the particle
    vec3 velocity;
    float distance; // at which contact begins
    float mass;     // of their bodies
    float fixed_weight; // of those who do not give way
    float weight;
};

float nearness(vec3 offset)
{
    float reach = TOUCH_REACH * params.spacing;
    float share = max(1.0 - dot(offset, offset) / (reach * reach), 0.0);
    return share * share;
}

void add_still(inout Near near, vec3 x)
{
    NearWalk walk = near_walk(x, TOUCH_REACH * params.spacing, still_table());
    FOR_EACH_NEAR(j, walk) {
        vec4 xj = load_candidate(position, j);
        bool is_collider = load_candidate(velocity, j).w == 0.0;
        float weight = xj.w * nearness(x - xj.xyz);
        near.offset += weight * (x - xj.xyz);
        near.distance += weight * (is_collider ? COLLIDER_CONTACT : SOLID_CONTACT);
        near.fixed_weight += weight;
        near.weight += weight;
    }
}

void add_bodies(inout Near near, vec3 x, uint own_body)
{
    NearWalk walk = near_walk(x, TOUCH_REACH * params.spacing, 0);
    FOR_EACH_NEAR(j, walk) {
        vec4 xj = load_candidate(position, j);
        vec4 vj = load_candidate(velocity, j);
        uint body = body_of[id[j]];
        bool is_other = xj.w > 0.0 && vj.w < 0.0 && body != own_body && body != NO_BODY;
        float weight = is_other ? xj.w * nearness(x - xj.xyz) : 0.0;
        near.offset += weight * (x - xj.xyz);
        near.velocity += weight * vj.xyz;
        near.distance += weight * SOLID_CONTACT;
        near.mass += weight * bodies[is_other ? body : own_body].mass;
        near.weight += weight;
    }
}

void main()
{
    uint i = invocation_index();
    if (i >= params.moving_count || !is_loose(attributes[i])) {
        return;
    }
    uint own_id = id[i];
    uint body = body_of[own_id];
    place[own_id] = i;
    vec3 x = position[i].xyz;
    Near near = Near(vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0, 0.0);
    uint all = shift_axes(x, TOUCH_REACH * params.spacing);
    FOR_EACH_SHIFT(axes, all) {
        add_still(near, shifted(x, axes));
        if (body_count > 1u) {
            add_bodies(near, shifted(x, axes), body);
        }
    }
    float far = length(near.offset);
    Touch touch = Touch(vec3(0.0), 0.0, vec3(0.0), 0.0);
    if (near.weight > 0.0 && far > 0.0 && body != NO_BODY) {
        float own_mass = bodies[body].mass;
        float fixed_share = near.fixed_weight / near.weight;
        float mass = near.mass / max(near.weight - near.fixed_weight, 1e-20);
        touch.normal = near.offset / far;
        touch.gap = (far - near.distance * params.spacing) / near.weight;
        touch.velocity = near.velocity / near.weight;
        touch.share = mix(mass / (own_mass + mass), 1.0, fixed_share);
    }
    touches[own_id] = touch;
}
