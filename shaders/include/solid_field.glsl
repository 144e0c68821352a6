// How solids fill the space around a place, and how that changes (shared/solid_splats.h). Include it after the declarations of
// `params`, `cell_start`, `living` and `living_texels`.
#ifndef SOLID_FIELD_GLSL
#define SOLID_FIELD_GLSL
#include "include/candidate.glsl"
#include "include/grid.glsl"
#include "shared/solid_splats.h"

struct SolidField {
    float filling;  // c
    vec3 gradient;  // 1/m
    float fluid;    // what fluid fills
};

// Through the moving particles and then through the still ones.
SolidField solid_field(vec3 x)
{
    float reach = SURFACE_SUPPORT * params.spacing;
    ivec3 size = ivec3(params.grid_size);
    ivec3 low = cell_coordinates(x - reach, params.domain_min, params.support_radius, params.grid_size);
    ivec3 high = cell_coordinates(x + reach, params.domain_min, params.support_radius, params.grid_size);
    low = clamp(low, ivec3(0), size - 1);
    high = clamp(high, ivec3(0), size - 1);
    int cells = size.x * size.y * size.z;
    SolidField field = SolidField(0.0, vec3(0.0), 0.0);
    for (int table = 0; table <= cells; table += cells) {
        for (int z = low.z; z <= high.z; ++z) {
            for (int y = low.y; y <= high.y; ++y) {
                int row = table + cell_index(ivec3(0, y, z), params.grid_size);
                uint end = cell_start[row + high.x + 1];
                for (uint j = cell_start[row + low.x]; j < end; ++j) {
                    vec4 neighbor = load_candidate(living, j);
                    vec3 offset = (x - neighbor.xyz) / reach;
                    float q = length(offset);
                    float u = max(1.0 - q, 0.0);
                    float u2 = u * u;
                    float shape = u2 * u2 * (1.0 + 4.0 * q);
                    float weight = max(neighbor.w, 0.0);
                    field.filling += weight * shape;
                    field.fluid += max(-neighbor.w, 0.0) * shape;
                    field.gradient -= weight * u2 * u * offset;
                }
            }
        }
    }
    // d^3 times Wendland's scale, 21 / (2 pi R^3); its slope has a factor of 20 / R.
    const float scale = 21.0 / (2.0 * 3.14159265) / (SURFACE_SUPPORT * SURFACE_SUPPORT * SURFACE_SUPPORT);
    field.filling *= scale;
    field.fluid *= scale;
    field.gradient *= 20.0 * scale / reach;
    return field;
}

// What was so wet before is after some seconds, where fluid fills so much around it.
float wetness_after(float seconds, float before, float fluid)
{
    float target = min(fluid / WET_FILLING, 1.0);
    return target + (before - target) * exp(-seconds / (target > before ? WETTING_TIME : DRYING_TIME));
}

#endif
