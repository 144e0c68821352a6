#version 460
#extension GL_GOOGLE_include_directive : require
// How the surface bends at the disc of each solid particle, from the normals of the discs around it (shared/solid_splats.h): the
// symmetric part of the linear map that fits them best. Twin: engine/reference/solid_splats.cpp.
#include "include/grid.glsl"
#include "include/invocation.glsl"
#include "include/tangent_frame.glsl"
#include "shared/solid_splats.h"

layout(push_constant, scalar) uniform Push { SolidSplatPush push; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer CellStart { uint cell_start[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Living { vec4 living[]; };
layout(set = 0, binding = 3, scalar) readonly buffer DiscPosition { vec4 disc_position[]; };
layout(set = 0, binding = 4, scalar) readonly buffer DiscNormal { vec4 disc_normal[]; };
layout(set = 0, binding = 5, scalar) buffer DiscBend { vec4 disc_bend[]; };

void main()
{
    uint i = invocation_index();
    if (i >= params.pool_count || disc_position[push.first_disc + i].w <= 0.0) {
        return;
    }
    uint disc = push.first_disc + i;
    vec3 center = disc_position[disc].xyz;
    vec3 normal = disc_normal[disc].xyz;
    vec3 u;
    vec3 v;
    tangent_frame(normal, u, v);

    float reach = BEND_REACH * params.spacing;
    vec3 x = living[i].xyz;
    ivec3 size = ivec3(params.grid_size);
    ivec3 low = cell_coordinates(x - reach, params.domain_min, params.support_radius, params.grid_size);
    ivec3 high = cell_coordinates(x + reach, params.domain_min, params.support_radius, params.grid_size);
    low = clamp(low, ivec3(0), size - 1);
    high = clamp(high, ivec3(0), size - 1);
    int cells = size.x * size.y * size.z;
    vec3 ways = vec3(0.0);  // sums of aa, ab, bb
    vec2 turn_u = vec2(0.0); // of the turn along u times a, times b
    vec2 turn_v = vec2(0.0);
    for (int table = 0; table <= cells; table += cells) {
        for (int z = low.z; z <= high.z; ++z) {
            for (int y = low.y; y <= high.y; ++y) {
                int row = table + cell_index(ivec3(0, y, z), params.grid_size);
                uint end = cell_start[row + high.x + 1];
                for (uint j = cell_start[row + low.x]; j < end; ++j) {
                    vec4 other = disc_position[push.first_disc + j];
                    if (other.w > 0.0) {
                        vec3 way = other.xyz - center;
                        vec3 apart = living[j].xyz - x;
                        vec3 turn = disc_normal[push.first_disc + j].xyz;
                        float weight = other.w * max(1.0 - dot(apart, apart) / (reach * reach), 0.0);
                        weight *= max(dot(turn, normal), 0.0); // the other side of something thin is no neighbor
                        vec2 at = vec2(dot(way, u), dot(way, v));
                        ways += weight * vec3(at.x * at.x, at.x * at.y, at.y * at.y);
                        turn_u += weight * dot(turn, u) * at;
                        turn_v += weight * dot(turn, v) * at;
                    }
                }
            }
        }
    }
    // Where there is nobody to tell, the surface is taken to be flat.
    float flat_share = FLATNESS * PARTICLE_SPLAT_RADIUS * params.spacing * params.spacing * params.spacing;
    ways += vec3(flat_share, 0.0, flat_share);
    float determinant = ways.x * ways.z - ways.y * ways.y;
    float uu = (turn_u.x * ways.z - turn_u.y * ways.y) / determinant;
    float vv = (turn_v.y * ways.x - turn_v.x * ways.y) / determinant;
    float uv = (turn_u.y * ways.x - turn_u.x * ways.y + turn_v.x * ways.z - turn_v.y * ways.y) / (2.0 * determinant);
    float most = MOST_BEND / (PARTICLE_SPLAT_RADIUS * params.spacing);
    disc_bend[disc].xyz = clamp(vec3(uu, uv, vv), vec3(-most), vec3(most));
}
