#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// What sun and air give, since the last look, to the exposed surface of solids where no fluid covers it (shared/melting.h). And
// the dead get the enthalpy that they would be born with. Twin: engine/reference/melting.cpp.
#define CELL_START_BINDING 1
#include "include/candidate.glsl"
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl" // of the moving particles alone
#include "include/sph_kernel.glsl"
#include "shared/exposure.h"
#include "shared/heat.h"
#include "shared/melting.h"
#include "shared/particle_state.h"
#include "shared/two_float.h"

layout(push_constant, scalar) uniform Push { float seconds; }; // of heat
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 2, scalar) uniform Heat { HeatParams heat; };
layout(set = 0, binding = 3, scalar) uniform Melting { MeltingParams melting; };
layout(set = 0, binding = 4, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 7, scalar) readonly buffer Velocity { vec4 velocity[]; };     // w: mass, negative of boundary particles
layout(set = 0, binding = 8, scalar) readonly buffer Exposure { vec4 exposure[]; };     // by id: n, A
layout(set = 0, binding = 9, scalar) readonly buffer Visibility { float visibility[]; }; // by id, for the sun
layout(set = 0, binding = 10, scalar) buffer Enthalpy { vec2 enthalpy[]; };             // by id, two-floats

// Part of space that fluid fills around a point.
float fluid_filling(vec3 x)
{
    KernelSize size = kernel_size(params.support_radius);
    vec3 walking[TILE]; // a walk is that of a tile
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        walking[k] = k == 0u ? x : NOWHERE;
    }
    float sum = 0.0;
    Walk walk = begin_walk(walking, params.domain_min, params.support_radius, params.grid_size);
    FOR_EACH_CANDIDATE(range, walk) {
        vec4 xj = position[range.x];
        vec3 offset = x - xj.xyz;
        float covers = velocity[range.x].w > 0.0 ? xj.w : 0.0; // no loose solid
        sum += covers * density_shape(dot(offset, offset), size);
    }
    return params.lattice_volume * params.density_scale * sum;
}

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count) {
        return;
    }
    uint slot = id[i];
    uint material = particle_material(attributes[i]);
    if (particle_state(attributes[i]) == STATE_DEAD) {
        enthalpy[slot] = vec2(melting.birth_enthalpy[material], 0.0);
    }
    vec4 surface = exposure[slot];
    if (particle_state(attributes[i]) != STATE_SOLID || surface.w <= 0.0) {
        return;
    }
    float mass = abs(velocity[i].w);
    float filling = fluid_filling(position[i].xyz + params.spacing * surface.xyz);
    float bare = 1.0 - min(filling / COVER_FILLING, 1.0);

    float facing = max(-dot(surface.xyz, melting.sun_direction), 0.0);
    float from_sun = melting.sun * melting.absorptivity[material] * facing * visibility[slot];
    float its_temperature = temperature(heat.of[material], enthalpy[slot]);
    float capacity = specific_heat(heat.of[material], enthalpy[slot].x); // 0 on the plateau: nothing gets warmer there
    float decays = capacity > 0.0 ? bare * melting.air_transfer * surface.w * seconds / (mass * capacity) : 0.0;
    float from_air = melting.air_transfer * (melting.air_temperature - its_temperature) * mean_decay(decays, exp(-decays));
    enthalpy[slot] = two_float_add(enthalpy[slot], bare * surface.w * (from_sun + from_air) * seconds / mass);
}
