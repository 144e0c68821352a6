// The twelve edges of the domain's box as thin quads of constant width on screen.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "include/splat.glsl"

layout(binding = 0, scalar) uniform Params { RenderParams params; };

// End `end` (0 or 1) of edge 0..11: four edges along each axis.
vec3 edge_end(uint edge, uint end)
{
    uint axis = edge / 4u;
    uint a = edge & 1u;
    uint b = (edge >> 1u) & 1u;
    uvec3 corner = axis == 0u ? uvec3(end, a, b) : axis == 1u ? uvec3(b, end, a) : uvec3(a, b, end);
    return mix(params.box_min, params.box_max, vec3(corner));
}

vec4 project(SplatCamera camera, vec3 point)
{
    vec2 plane = camera.orthographic != 0u ? point.xy : point.xy / -point.z;
    return vec4((plane - camera.plane_offset) / camera.plane_scale, depth_at(camera, -point.z), 1.0);
}

void main()
{
    SplatCamera camera = params.camera;
    uint edge = uint(gl_VertexIndex) / VERTICES_PER_QUAD;
    uint vertex = uint(gl_VertexIndex) % VERTICES_PER_QUAD;
    vec3 a = (camera.view * vec4(edge_end(edge, 0u), 1.0)).xyz;
    vec3 b = (camera.view * vec4(edge_end(edge, 1u), 1.0)).xyz;

    float excess_a = -a.z - camera.near_distance;
    float excess_b = -b.z - camera.near_distance;
    if (excess_a < 0.0 && excess_b < 0.0) {
        gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
        return;
    }
    if (excess_a < 0.0) {
        a = mix(a, b, excess_a / (excess_a - excess_b));
    } else if (excess_b < 0.0) {
        b = mix(b, a, excess_b / (excess_b - excess_a));
    }
    vec4 start = project(camera, a);
    vec4 stop = project(camera, b);
    vec2 along = (stop.xy - start.xy) / camera.pixel;
    float len = length(along);
    along = len > 1e-3 ? along / len : vec2(1.0, 0.0);

    uint corner = vertex < 3u ? vertex : (vertex == 3u ? 2u : (vertex == 4u ? 1u : 3u));
    vec2 across = vec2(-along.y, along.x) * ((corner & 2u) != 0u ? 0.5 : -0.5) * params.line_width;
    gl_Position = (corner & 1u) != 0u ? stop : start;
    gl_Position.xy += across * camera.pixel;
}
