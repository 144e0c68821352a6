#version 460
#extension GL_GOOGLE_include_directive : require
// The height of each column of sand, which follows what stands there (shared/sand_surface.h). Twin:
// engine/reference/sand_surface.cpp.
#include "include/invocation.glsl"
#include "shared/particle_state.h"
#include "shared/sand_surface.h"
#include "shared/solid_splats.h"
#include "shared/visibility.h"

layout(push_constant, scalar) uniform Push { SandPush push; };
layout(set = 0, binding = 0, scalar) uniform Splats { SolidSplatParams splats; };
layout(set = 0, binding = 1, scalar) uniform View { VisibilityParams view; };                // from above
layout(set = 0, binding = 2, scalar) readonly buffer GroundBuffer { vec4 ground[]; };        // w: the top, m above the floor
layout(set = 0, binding = 3, scalar) readonly buffer TopId { uint top_id[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Damage { vec2 damage[]; };              // by id, two-floats
layout(set = 0, binding = 5, scalar) readonly buffer Place { uint place[]; };                // by id
layout(set = 0, binding = 6, scalar) readonly buffer Attributes { uint attributes[]; };
// Kept: x: height, m; y: 1 of sand and of the floor, 0 of what else stands there; z: how much it is sand, 0 to 1.
layout(set = 0, binding = 7, scalar) buffer Column { vec4 column[]; };
layout(set = 0, binding = 8, scalar) buffer Tint { vec4 tint[]; }; // kept: its color

void main()
{
    uint i = invocation_index();
    if (i >= view.width * view.height) {
        return;
    }
    uint slot = top_id[i];
    float top = ground[i].w;
    bool is_floor = top < 0.0;
    bool has_top = slot != 0xffffffffu;
    uint material = has_top ? particle_material(attributes[place[slot]]) : 0u;
    bool is_sand = has_top && splats.is_sand[material] != 0u;
    float taken = is_sand ? clamp(damage[slot].x, 0.0, 1.0) : 0.0;
    float height = is_floor ? 0.0 : top + (0.5 - taken) * view.spacing;

    float follows = push.first != 0u ? 1.0 : 1.0 - exp(-push.seconds / COLUMN_TIME);
    bool is_ground = is_sand || is_floor;
    vec4 before = column[i];
    bool was_ground = before.y > 0.0;
    float share = before.z + follows * ((is_sand ? 1.0 : 0.0) - before.z);
    column[i] = vec4(is_ground && was_ground ? before.x + follows * (height - before.x) : height, is_ground ? 1.0 : 0.0, share, 0.0);
    if (is_sand) {
        vec3 color = splats.color[material];
        tint[i] = vec4(before.z > 0.0 ? mix(tint[i].rgb, color, follows) : color, 1.0);
    }
}
