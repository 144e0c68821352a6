#version 460
#extension GL_GOOGLE_include_directive : require
// Sand at the surface: the wind takes what it is able to since the last look, counted as damage, and whose damage is complete
// hops, at the look that is nearest to its time, if it is the top of its column: nobody leaves from under others. Twin:
// engine/reference/wind.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/pool_changes.h"
#include "shared/sph_params.h"
#include "shared/two_float.h"
#include "shared/visibility.h"
#include "shared/wind.h"

layout(push_constant, scalar) uniform Push { WindPush push; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform Wind { WindParams wind; };
layout(set = 0, binding = 2, scalar) uniform View { VisibilityParams view; };
layout(set = 0, binding = 3, scalar) readonly buffer GroundBuffer { vec4 ground[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Exposure { vec4 exposure[]; };     // by id: n, A
layout(set = 0, binding = 6, scalar) readonly buffer Visibility { float visibility[]; }; // by id, for the wind
layout(set = 0, binding = 7, scalar) buffer Damage { vec2 damage[]; };                  // by id, two-floats: 1 is complete
layout(set = 0, binding = 8, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 9, scalar) buffer Position { vec4 position[]; }; // w: weight
layout(set = 0, binding = 10, scalar) buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 11, scalar) buffer Changes { PoolChanges changes; };
layout(set = 0, binding = 12, scalar) readonly buffer TopId { uint top_id[]; };  // of each texel
layout(set = 0, binding = 13, scalar) writeonly buffer Way { uint way[]; };      // of each texel: WAY_*

#include "include/ground.glsl"

void main()
{
    uint i = params.moving_count + invocation_index();
    if (i >= params.pool_count || particle_state(attributes[i]) != STATE_SOLID) {
        return;
    }
    uint material = particle_material(attributes[i]);
    WindMaterial sand = wind.of[material];
    if (sand.erodes == 0u) {
        return;
    }
    uint slot = id[i];
    ivec2 texel = texel_at(position[i].xyz);
    vec4 surface = exposure[slot];
    float stress = stress_on_slope(dot(ground_at(texel).slope, wind.direction));
    // Flux goes with the third power of the friction velocity, the stress with the second.
    float share = stress > sand.threshold && dot(surface.xyz, wind.up) > 0.0 ? stress * sqrt(stress) : 0.0;
    float taken = sand.pick_up * share * visibility[slot] * surface.w * push.seconds / abs(velocity[i].w);
    damage[slot] = two_float_add(damage[slot], taken);

    if (damage[slot].x + push.ahead * taken >= 1.0 && top_id[index_of(texel)] == slot) {
        attributes[i] = freed_as(attributes[i], STATE_DUST, CAUSE_WIND);
        position[i].w = 0.0;
        velocity[i].xyz = sand.launch_speed * launch_share(slot) * wind.up;
        damage[slot] = vec2(0.0);
        way[index_of(texel)] = WAY_TAKEN;
        atomicAdd(changes.freed, 1u);
        atomicAdd(changes.picked_up[material], 1u);
    }
}
