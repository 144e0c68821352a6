#version 460
#extension GL_GOOGLE_include_directive : require
// What conduction reads of each particle (shared/heat.h): found once, not for each pair. And which cells hold one that is not at
// the common temperature. Twin: engine/reference/heat.cpp.
#include "include/invocation.glsl"
#include "shared/heat.h"
#include "shared/particle_state.h"
#include "shared/sph_params.h"

layout(push_constant, scalar) uniform Push { float common_temperature; }; // degrees C
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform Heat { HeatParams heat; };
layout(set = 0, binding = 2, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Position { vec4 position[]; }; // w: weight
layout(set = 0, binding = 5, scalar) readonly buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 6, scalar) readonly buffer Enthalpy { vec2 enthalpy[]; }; // by id, two-floats
layout(set = 0, binding = 7, scalar) writeonly buffer Thermal { vec4 thermal[]; };
layout(set = 0, binding = 8, scalar) buffer WarmCells { uint warm_cells[]; };

#include "include/warm_cells.glsl"

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count) {
        return;
    }
    uint state = particle_state(attributes[i]);
    uint material = particle_material(attributes[i]);
    bool holds = state == STATE_COLLIDER;
    bool has_heat = holds || state == STATE_SOLID || state == STATE_FLUID;
    HeatMaterial its = heat.of[material];
    vec2 h = enthalpy[id[i]];
    float k = has_heat ? conductivity(its, h.x) : 0.0;
    float specific_volume = position[i].w / params.rest_density[material]; // 1 / rho0; of solids, theirs
    float volume = holds ? position[i].w * params.lattice_volume : abs(velocity[i].w) * specific_volume;
    bool changes = !holds && k > 0.0;
    float t = temperature(its, h);
    thermal[i] = k > 0.0 ? vec4(t, k, volume, changes ? specific_volume : 0.0) : vec4(0.0);
    if (k > 0.0 && t != common_temperature) {
        ivec3 cell = cell_within(position[i].xyz);
        atomicOr(warm_cells[warm_row(cell.yz) + uint(cell.x) / 32u], 1u << (uint(cell.x) % 32u));
    }
}
