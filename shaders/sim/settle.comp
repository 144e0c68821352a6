#version 460
#extension GL_GOOGLE_include_directive : require
// What passes read of still particles and no pass of a step writes: they have no density, pressure and acceleration of their
// own, and their volume and friction stay. Twin: engine/reference/density.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/sph_params.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer Position { vec4 position[]; }; // w: weight
layout(set = 0, binding = 2, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Acceleration { vec4 acceleration[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Density { float density[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer Pressure { float pressure[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer Interaction { vec4 interaction[]; }; // of shared/sph_params.h

void main()
{
    uint i = params.moving_count + invocation_index();
    if (i < params.pool_count) {
        float volume = position[i].w * params.lattice_volume;
        float friction = params.friction[particle_material(attributes[i])];
        acceleration[i] = vec4(0.0);
        density[i] = 0.0;
        pressure[i] = 0.0;
        interaction[i] = vec4(0.0, volume, params.viscosity_scale * friction * volume, 0.0);
    }
}
