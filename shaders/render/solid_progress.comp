#version 460
#extension GL_GOOGLE_include_directive : require
// What splats need of each particle (shared/solid_splats.h): how much of it is left as a solid, where it lies, and the size of its
// ball. Twin: engine/reference/solid_splats.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/solid_splats.h"

layout(push_constant, scalar) uniform Push { SolidSplatPush push; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform Splats { SolidSplatParams splats; };
layout(set = 0, binding = 2, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Density { float density[]; }; // of dust: what is left of it
layout(set = 0, binding = 6, scalar) readonly buffer ReleaseTime { float release_time[]; }; // by id, s
layout(set = 0, binding = 7, scalar) readonly buffer Enthalpy { vec2 enthalpy[]; };         // by id, J/kg, two-floats
layout(set = 0, binding = 8, scalar) readonly buffer Damage { vec2 damage[]; };             // by id, two-floats
// xyz: where it is; w: 1 - p of solids, -1 of fluid, 0 of others.
layout(set = 0, binding = 9, scalar) writeonly buffer Living { vec4 living[]; };
layout(set = 0, binding = 10, scalar) writeonly buffer Place { uint place[]; }; // by id
layout(set = 0, binding = 11, scalar) writeonly buffer Size { float size[]; };  // of its ball, in radii of a particle

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count) {
        return;
    }
    uint slot = id[i];
    uint state = particle_state(attributes[i]);
    uint material = particle_material(attributes[i]);
    place[slot] = i;

    float front = 0.0;
    if ((splats.progress & PROGRESS_FRONT) != 0u && splats.front_time[material] > 0.0) {
        front = front_progress(release_time[slot], push.time, splats.front_time[material]);
    }
    float progress = front;
    if ((splats.progress & PROGRESS_MELTING) != 0u && splats.latent_heat[material] > 0.0) {
        progress = max(progress, clamp(enthalpy[slot].x / splats.latent_heat[material], 0.0, 1.0));
    }
    if ((splats.progress & PROGRESS_DAMAGE) != 0u) {
        progress = max(progress, clamp(damage[slot].x, 0.0, 1.0));
    }
    float left = 0.0;
    float ball = 1.0;
    switch (state) {
    case STATE_SOLID:
        left = 1.0 - progress;
        ball = front;
        break;
    case STATE_FLUID: {
        left = -1.0;
        uint cause = cause_of(attributes[i]);
        if (splats.blend_time > 0.0 && (cause == CAUSE_MELT || cause == CAUSE_HYDRAULIC)) {
            ball = smooth_ramp(0.0, splats.blend_time, push.time - release_time[slot]);
        }
        break;
    }
    case STATE_DUST:
        ball = pow(density[i], 1.0 / 3.0);
        break;
    case STATE_DEAD:
        ball = 0.0;
        break;
    }
    living[i] = vec4(position[i].xyz, left);
    size[i] = ball;
}
