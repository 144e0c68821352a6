// Everything a draw needs besides the particles themselves: one struct in one device buffer, written for each frame.
#ifndef MELTPOINT_SHARED_RENDER_PARAMS_H
#define MELTPOINT_SHARED_RENDER_PARAMS_H
#include "prelude.h"
#include "sph_params.h"

SHARED_BEGIN

SHARED_CONSTANT uint COLOR_MATERIAL = 0u;
SHARED_CONSTANT uint COLOR_DENSITY = 1u;  // magenta below the rest density, the colormap above
SHARED_CONSTANT uint COLOR_SPEED = 2u;
SHARED_CONSTANT uint COLOR_PRESSURE = 3u;
SHARED_CONSTANT uint COLOR_NORMAL = 4u;   // world-space normal n as linear color (n + 1)/2, never lit

// What a sample of the visibility image shows: kind in the upper bits, index of particle, disc or triangle below.
SHARED_CONSTANT uint SURFACE_NONE = 0u;
SHARED_CONSTANT uint SURFACE_SPHERE = 1u;
SHARED_CONSTANT uint SURFACE_DISC = 2u;
SHARED_CONSTANT uint SURFACE_LINE = 3u;
SHARED_CONSTANT uint SURFACE_SAND = 4u;
SHARED_CONSTANT uint SURFACE_SHIFT = 28u;

// Discs, in the w of their normals. Flat ones are seen from both sides, the others from outside.
SHARED_CONSTANT float DISC_FLAT = 0.0f;
SHARED_CONSTANT float DISC_BENT = 1.0f; // its normals turn along it, and it ends where the surface has left its plane
SHARED_CONSTANT float DISC_EDGED = 2.0f; // flat, and cut off along a line

// How glossy spheres are: as a wet disc, or, in the data modes, hardly.
SHARED_CONSTANT float GLOSS_DRY = 0.0f;
SHARED_CONSTANT float GLOSS_WET = 1.0f;
SHARED_CONSTANT float GLOSS_MATTE = 2.0f;
SHARED_CONSTANT float GLOSS_PUFF = 3.0f; // dry, of sand in the air, of which specks are seen

// In radii of a bent disc: how far the surface may be off its plane.
SHARED_CONSTANT float BENT_OFF = 0.15f;

// A camera as splats need it. View space is right-handed and looks along -z; d = -z is the distance along the view axis.
// The view plane of a point is (x, y)/d, of an orthographic camera (x, y): straight lines in it are straight on screen.
struct SplatCamera {
    mat4 view;            // world to view space
    vec2 plane_scale;     // view plane = ndc * plane_scale + plane_offset
    vec2 plane_offset;
    vec2 depth_map;       // depth (reversed: 1 near, 0 far) = x + y/d, of an orthographic camera x + y d
    vec2 pixel;           // size of a pixel in ndc
    float near_distance;  // m, along the view axis; surfaces nearer than this are cut away
    float far_distance;   // m, may be infinite
    uint orthographic;    // 1: all rays are parallel
};

// Splats are drawn as quads of two triangles.
SHARED_CONSTANT uint VERTICES_PER_QUAD = 6u;

// Of an indirect draw (VkDrawIndirectCommand).
struct DrawArguments {
    uint vertices;
    uint instances;
    uint first_vertex;
    uint first_instance;
};

// Push constants of the passes that draw splats.
struct SplatPush {
    SplatCamera camera;
};

// Of those that find their quads.
struct QuadPush {
    SplatCamera camera;
    uint count;
    uint puffs; // 1: sand in the air is seen; 0: it casts no shadow
};

// What all passes of a frame read.
struct RenderParams {
    SplatCamera camera;
    SplatCamera light; // orthographic, of the shadow map
    mat4 view_to_world;
    vec3 light_direction; // world space, unit, from the scene to the light
    float splat_radius;   // m, of particles
    vec3 background;      // colors are linear RGB
    uint color_mode;      // COLOR_*
    vec2 color_range;     // at the ends of the colormap, in the mode's unit
    uint lit;             // 0: plain colors without light and shadow
    uint shadows;         // 1: the shadow map is there
    vec3 floor_color;
    float floor_height;   // m; the floor's plane is y = floor_height
    vec2 floor_center;    // m, x and z
    float floor_extent;   // m; the floor has faded into the background at this distance from its center; 0: no floor
    float floor_grid;     // m between the floor's lines
    vec3 box_min;         // m
    float line_width;     // samples
    vec3 box_max;
    uint samples;         // samples of the visibility image along a pixel's side
    vec3 line_color;
    vec3 material_color[MAX_MATERIALS];
    vec3 solid_color[MAX_MATERIALS]; // of it as a solid
    float rest_density[MAX_MATERIALS]; // kg/m^3
    float time;       // s, of the frame
    uint sized;       // 1: each sphere has a size of its own
    float blend_time; // s, in which what was solid takes on the color of its fluid; 0 where nobody knows when it was freed
};

SHARED_END
#endif
