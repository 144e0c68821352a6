#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// What flow has done to the surface of solids since the last look, at the rates that it had then; and the rates from now on, of
// which the host must know the fastest to say when to look again (shared/hydraulic.h). Twin: engine/reference/hydraulic.cpp.
#define CELL_START_BINDING 1
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl" // of the moving particles alone
#include "include/sph_kernel.glsl"
#include "shared/exposure.h"
#include "shared/hydraulic.h"
#include "shared/particle_state.h"
#include "shared/two_float.h"

layout(push_constant, scalar) uniform Push { float seconds; }; // since the last look
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) uniform Hydraulic { HydraulicParams hydraulic; };
layout(set = 0, binding = 3, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Position { vec4 position[]; }; // w: weight
layout(set = 0, binding = 6) uniform textureBuffer position_texels;
layout(set = 0, binding = 7, scalar) readonly buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 8) uniform textureBuffer velocity_texels;
layout(set = 0, binding = 9, scalar) readonly buffer Exposure { vec4 exposure[]; };  // by id: n, A
layout(set = 0, binding = 10, scalar) readonly buffer Strength { float strength[]; }; // by id
layout(set = 0, binding = 11, scalar) buffer Damage { vec2 damage[]; };               // by id, two-floats
layout(set = 0, binding = 12, scalar) buffer Rate { float rate[]; };                  // by id, 1/s
layout(set = 0, binding = 13, scalar) buffer Fastest { uint fastest; }; // bits of the largest rate; in order, as none is negative

// The mean velocity of the fluid around a point, and in w the part of space that it fills there.
vec4 flow_at(vec3 x)
{
    KernelSize size = kernel_size(params.support_radius);
    vec3 walking[TILE]; // a walk is that of a tile
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        walking[k] = k == 0u ? x : NOWHERE;
    }
    vec4 sum = vec4(0.0); // dust and the dead have no weight
    Walk walk = begin_walk(walking, params.domain_min, params.support_radius, params.grid_size);
    FOR_EACH_CANDIDATE(range, walk) {
        vec4 xj = load_candidate(position, range.x);
        vec3 offset = x - xj.xyz;
        vec4 vj = load_candidate(velocity, range.x);
        float share = vj.w > 0.0 ? xj.w * density_shape(dot(offset, offset), size) : 0.0; // no loose solid
        sum += share * vec4(vj.xyz, 1.0);
    }
    vec3 mean = sum.w > 0.0 ? sum.xyz / sum.w : vec3(0.0);
    return vec4(mean, params.lattice_volume * params.density_scale * sum.w);
}

// dD/dt, 1/s, of a particle with an exposed surface.
float damage_rate(uint material, vec3 x, vec3 v, float mass, vec4 surface, float its_strength)
{
    vec4 flow = flow_at(x + params.spacing * surface.xyz);
    vec3 along = flow.xyz - v;
    along -= dot(along, surface.xyz) * surface.xyz;
    float shear = length(along) / params.spacing;
    float stress = shear > 0.0 ? hydraulic.consistency * pow(shear, hydraulic.flow_exponent) : 0.0;
    float excess = stress / its_strength - hydraulic.threshold[material];
    float loss = excess > 0.0 ? hydraulic.rate[material] * pow(excess, hydraulic.exponent[material]) : 0.0;
    float wet = min(flow.w / COVER_FILLING, 1.0);
    return hydraulic.time_scale * wet * loss * surface.w / (its_strength * mass);
}

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count) {
        return;
    }
    uint slot = id[i];
    uint material = particle_material(attributes[i]);
    if (particle_state(attributes[i]) != STATE_SOLID || hydraulic.erodes[material] == 0u) {
        rate[slot] = 0.0;
        return;
    }
    damage[slot] = two_float_add(damage[slot], rate[slot] * seconds);
    vec4 surface = exposure[slot];
    float now = surface.w > 0.0 ? damage_rate(material, position[i].xyz, velocity[i].xyz, abs(velocity[i].w), surface, strength[slot]) : 0.0;
    rate[slot] = now;
    atomicMax(fastest, floatBitsToUint(now));
}
