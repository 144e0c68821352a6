#version 460
#extension GL_GOOGLE_include_directive : require
// How large each piece of solids is, and whether anything holds it: an anchor that is not loose (shared/rigid.h). Twin:
// engine/reference/fragments.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/rigid.h"

layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer CellStart { uint cell_start[]; };
layout(set = 0, binding = 2, scalar) uniform Rigid { RigidParams rigid; };
layout(set = 0, binding = 3, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 6) uniform textureBuffer position_texels;
layout(set = 0, binding = 7, scalar) readonly buffer Velocity { vec4 velocity[]; }; // w: mass, negative of boundary particles
layout(set = 0, binding = 8) uniform textureBuffer velocity_texels;
layout(set = 0, binding = 9, scalar) readonly buffer Label { uint label[]; }; // by id
layout(set = 0, binding = 10, scalar) buffer Pieces { Piece pieces[]; };      // by name

#include "include/near_walk.glsl"

bool touches_wall(vec3 x)
{
    vec3 reach = vec3(BOND_DISTANCE * params.spacing);
    uvec3 low = uvec3(lessThan(x - params.domain_min, reach));
    uvec3 high = uvec3(lessThan(params.domain_max - x, reach));
    uvec3 near = low | high << 1u;
    return (params.wall_mask & (near.x | near.y << 2u | near.z << 4u)) != 0u;
}

bool touches_collider(vec3 x)
{
    float reach = BOND_DISTANCE * params.spacing;
    bool found = false;
    uint all = shift_axes(x, reach);
    FOR_EACH_SHIFT(axes, all) {
        NearWalk walk = near_walk(shifted(x, axes), reach, still_table());
        FOR_EACH_NEAR(j, walk) {
            found = found || load_candidate(velocity, j).w == 0.0; // of those who are still, colliders alone have no mass
        }
    }
    return found;
}

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count || particle_state(attributes[i]) != STATE_SOLID) {
        return;
    }
    uint name = label[id[i]];
    atomicAdd(pieces[name].size, 1u);
    uint anchor = rigid.anchor[particle_material(attributes[i])];
    if (is_loose(attributes[i]) || anchor == ANCHOR_NONE) {
        return;
    }
    vec3 x = position[i].xyz;
    if (anchor == ANCHOR_ALL || touches_wall(x) || touches_collider(x)) {
        atomicMax(pieces[name].held, 1u);
    }
}
