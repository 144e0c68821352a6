#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
// Accelerations: pressure, viscosity and the paper's surface tension, of the particles and their images in the walls; gravity;
// wall friction and contact. Pair forces are symmetric, so momentum is conserved: F_ij = -(p_i V_i^2 + p_j V_j^2) grad W + mu V_i V_j (v_j - v_i) lap W, with V = m / rho
// (Mueller et al. 2003 as corrected; Solenthaler & Pajarola 2008). Twin: engine/reference/forces.cpp.
#define CELL_START_BINDING 1
#include "include/invocation.glsl"
#include "include/neighbor_walk.glsl"
#include "include/sph_kernel.glsl"

layout(constant_id = 2) const bool TENSION = false;

layout(set = 0, binding = 0, scalar) readonly buffer Params { SphParams params; };
layout(set = 0, binding = 2, scalar) readonly buffer Position { vec4 position[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Density { float density[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Pressure { float pressure[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer Acceleration { vec4 acceleration[]; };

#include "include/image_walk.glsl"

// Friction against walls at rest, and the contact spring.
vec3 wall_acceleration(vec3 x, vec3 v, float rho)
{
    float h = params.support_radius;
    Walls walls = nearest_walls(x, params.domain_min, params.domain_max, params.wall_mask);
    vec3 a = vec3(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        float s = walls.distance[axis];
        if (s >= h) {
            continue;
        }
        if (s < params.contact_distance) {
            float speed = v[axis] * walls.normal[axis];
            float spring = params.contact_stiffness * (params.contact_distance - s);
            a[axis] += max(spring - params.contact_damping * speed, 0.0) * walls.normal[axis];
        }
        a -= params.wall_viscosity / rho * params.viscosity_scale * half_space_viscosity(s, h) * v;
    }
    return a;
}

// Mueller et al. 2003: -sigma lap(c) n / |n| where the surface is, a look. n points into the fluid.
vec3 tension_acceleration(vec3 n, float laplacian, float rho)
{
    float length_n = length(n);
    if (length_n * params.support_radius <= params.tension_threshold) {
        return vec3(0.0);
    }
    return -params.surface_tension / rho * laplacian / length_n * n;
}

void main()
{
    if (invocation_index() * TILE >= params.particle_count) {
        return;
    }
    vec3 own[TILE];
    Tile tile = load_tile(invocation_index(), own);

    float h = params.support_radius;
    KernelSize size = kernel_size(h);
    vec3 v[TILE];
    float pressure_term[TILE]; // p V^2 gradient_scale
    float viscous_term[TILE];  // mu V viscosity_scale
    vec3 force[TILE];
    vec3 color_gradient[TILE];
    float color_laplacian[TILE];
    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = min(tile.first + k, tile.last);
        v[k] = velocity[i].xyz;
        float volume = position[i].w / density[i];
        pressure_term[k] = params.gradient_scale * pressure[i] * volume * volume;
        viscous_term[k] = params.viscosity_scale * params.viscosity * volume;
        force[k] = vec3(0.0);
        color_gradient[k] = vec3(0.0);
        color_laplacian[k] = 0.0;
    }

    for (uint image = 0u; image < IMAGES; ++image) {
        if (!has_image(tile, image)) {
            continue;
        }
        vec3 x[TILE];
        Walk walk = begin_image_walk(own, image, x);
        vec3 signs = image_signs(image); // reflects a vector at the walls of this image
        FOR_EACH_CANDIDATE(range, walk) {
            uint j = range.x;
            vec4 xj = position[j];
            vec3 vj = signs * velocity[j].xyz;
            float volume_j = xj.w / density[j];
            float pressure_term_j = params.gradient_scale * pressure[j] * volume_j * volume_j;
            [[unroll]] for (uint k = 0u; k < TILE; ++k) {
                vec3 offset = signs * (x[k] - xj.xyz);
                float r2 = dot(offset, offset);
                vec2 shape = force_shapes(r2, size);
                force[k] += (pressure_term[k] + pressure_term_j) * shape.x * offset;
                force[k] += viscous_term[k] * volume_j * shape.y * (vj - v[k]);
                if (TENSION) {
                    vec2 color = color_shapes(r2, size);
                    color_gradient[k] -= volume_j * color.x * offset;
                    color_laplacian[k] += volume_j * color.y;
                }
            }
        }
    }

    [[unroll]] for (uint k = 0u; k < TILE; ++k) {
        uint i = tile.first + k;
        if (i > tile.last) {
            break;
        }
        vec3 a = params.gravity + force[k] / position[i].w;
        a += wall_acceleration(own[k], v[k], density[i]);
        if (TENSION) {
            a += tension_acceleration(params.color_gradient_scale * color_gradient[k],
                                      params.color_laplacian_scale * color_laplacian[k], density[i]);
        }
        acceleration[i] = vec4(a, 0.0);
    }
}
