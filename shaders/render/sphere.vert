// Particles as spheres: each pulls its particle and spans the quad that covers the sphere on screen.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "include/splat.glsl"
#include "shared/particle_state.h"

layout(binding = 0, scalar) readonly buffer Positions { vec4 position[]; };
layout(binding = 1, scalar) readonly buffer Attributes { uint attributes[]; };
layout(binding = 2, scalar) readonly buffer Densities { float density[]; }; // of dust: what is left of it
layout(binding = 3, scalar) readonly buffer Sizes { float size[]; }; // in radii, where push.sized
layout(binding = 4, scalar) readonly buffer Ids { uint id[]; };      // likewise
layout(push_constant, scalar) uniform Push { SplatPush push; };

layout(location = 0) flat out vec3 out_center; // view space
layout(location = 1) flat out uint out_particle;
layout(location = 2) flat out float out_radius;
layout(location = 3) flat out uint out_puff; // of sand in the air: its id, and 1; else 0

void main()
{
    uint particle = uint(gl_VertexIndex) / VERTICES_PER_QUAD;
    vec3 center = (push.camera.view * vec4(position[particle].xyz, 1.0)).xyz;
    float radius = push.sized != 0u ? push.radius * size[particle]
                                    : particle_radius(push.radius, attributes[particle], density[particle]);

    gl_Position = NO_QUAD;
    // One round, or none, as in disc.vert.
    bool is_puff = push.sized != 0u && is_flying_sand(attributes[particle]);
    bool is_drawn = particle_state(attributes[particle]) != STATE_DEAD && (!is_puff || push.puffs != 0u);
    uint rounds = is_drawn && radius > 0.0 ? 1u : 0u;
    for (uint k = 0u; k < rounds; ++k) {
        vec4 bound = sphere_bound(push.camera, center, radius);
        gl_Position = quad_vertex(push.camera, bound, -center.z - radius, uint(gl_VertexIndex) % VERTICES_PER_QUAD);
    }
    out_center = center;
    out_particle = particle;
    out_radius = radius;
    out_puff = is_puff ? id[particle] + 1u : 0u;
}
