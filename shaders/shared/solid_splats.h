// The surface of solids that erode, in pictures: flat discs (splats) that recede as their solid does, so that nothing pops.
//
// A solid particle's progress p goes from 0, whole, to 1, about to be freed: the part of its latent heat that it has taken up,
// its damage, or the part of the way that a front has come through its cell. The solid fills, of the space around x,
//     c(x) = sum_j d^3 (1 - p_j) W(|x - x_j|),
// a sum over solid particles with Wendland's kernel of a support radius of its own, and its surface is where c = 1/2. A particle
// that is freed at p = 1 counted for nothing before, so this surface never jumps. Flat and whole, it lies half a spacing outside of
// the first layer of a lattice; when that layer is about to go, half a spacing outside of the second one.
//
// Particle splats: a particle near the surface has a disc on it, with the normal -grad c / |grad c|, as far off as c says of a flat
// surface. Its normals bend as those of the discs around it do (Phong splats, Botsch, Spernat & Kobbelt 2004). It comes and goes
// with the particle's exposed area, A / d^2 = 2 d |grad c|, and goes with the particle.
//
// Surface splats lie on the solid's own shape, whose edges are sharp, a little outside of the particles' ones. Each belongs to
// the three solid particles below it: it moves and turns with them, recedes by their mean progress, and is gone with the first of
// them, or when they part, as those of sand that slides. At a sharp edge its disc is cut off, where the next face is, which
// recedes as well. Below it, particle splats keep out of its way, for the steps of a lattice are not the shape that it fills;
// before something has gone nearby they only stop gaps at edges. When the first of its hosts is about to go, or what is left has
// drawn back from where it lies, it sinks to the surface where c = 1/2 and turns as that does, and the particle splats come up
// over it: nobody sees it shrink. Only where that surface lies across it, it does so at once. Whose host was ever freed is gone
// for good.
//
// What is too thin for a surface (a chain, a lone particle) is drawn as balls. What melts or is washed away grows into its ball
// while it takes on the color of its fluid; what a front frees does before, inside of the solid.
#ifndef MELTPOINT_SHARED_SOLID_SPLATS_H
#define MELTPOINT_SHARED_SOLID_SPLATS_H
#include "prelude.h"
#include "sph_params.h"

SHARED_BEGIN

SHARED_CONSTANT float SURFACE_SUPPORT = 2.5f; // support radius of c, in spacings: a sheet of one layer has c = 0.6 yet
SHARED_CONSTANT float SURFACE_LEVEL = 0.5f;   // c at the surface

// A / d^2 from which and up to which a particle splat grows. A whole flat face has 0.9, the layer below it 0.06.
SHARED_CONSTANT float EXPOSED_FROM = 0.2f;
SHARED_CONSTANT float EXPOSED_FULLY = 0.4f;

// c of a particle with no surface beside it, below which and from which up it is, and is not, a ball.
SHARED_CONSTANT float THIN_FULLY = 0.55f;
SHARED_CONSTANT float THIN_FROM = 0.75f;

SHARED_CONSTANT float PARTICLE_SPLAT_RADIUS = 1.0f;  // spacings: discs of a cubic lattice overlap from 0.71 on
SHARED_CONSTANT float PARTICLE_SPLAT_DEPTH = 0.25f;   // spacings below the surface, so that surface splats cover them
SHARED_CONSTANT float COVERED_DEPTH = 0.35f;         // spacings farther below, where a surface splat covers them whole
SHARED_CONSTANT float BACKING_DEPTH = 0.4f;          // and so much more where nothing has gone nearby yet: there they
SHARED_CONSTANT float BACKING_RADIUS = 0.75f;        // only stop gaps between surface splats at edges
SHARED_CONSTANT float BACKING_REACH = 0.75f;         // spacings from the surface splat above them to its edge
SHARED_CONSTANT float NO_EDGE = 1e9f;
SHARED_CONSTANT float UNCHANGED = 1e-3f;             // part of c that rounding may lose
SHARED_CONSTANT float ERODED_FROM = 0.02f;           // lost part of c from which up to which they come
SHARED_CONSTANT float ERODED_FULLY = 0.1f;
SHARED_CONSTANT uint NO_COVER = 0xffffffffu;         // of a particle without one
SHARED_CONSTANT float SURFACE_SPLAT_SPACING = 0.5f;  // of surface splats, in spacings
SHARED_CONSTANT float SURFACE_SPLAT_RADIUS = 1.25f;   // in spacings of their own
SHARED_CONSTANT float RECESSION = 1.0f;              // spacings, of a surface splat whose hosts are about to go
SHARED_CONSTANT float MOST_STRETCH = 1.5f;            // spans, of a surface splat whose hosts have parted: then it is gone
SHARED_CONSTANT float DYING_FROM = 0.5f;             // progress beyond which particle splats shrink

// Progress of the first host to go at which a surface splat begins to sink, has sunk, and begins to shrink.
SHARED_CONSTANT float SINKING_FROM = 0.5f;
SHARED_CONSTANT float SINKING_UNTIL = 0.9f;
SHARED_CONSTANT float SHRINKING_FROM = 0.8f;
SHARED_CONSTANT float SINKING_DEPTH = 0.1f; // spacings, below particle splats
// c where it lies, of that at the start, at which it begins to sink, and has sunk: it would stand out of what is left.
SHARED_CONSTANT float BARE_FROM = 0.8f;
SHARED_CONSTANT float BARE_FULLY = 0.5f;


// Spacings: a disc bends as those so near to it do.
SHARED_CONSTANT float BEND_REACH = 2.0f;
SHARED_CONSTANT float FLATNESS = 0.1f;  // of a disc without neighbors, against one neighbor a spacing off
SHARED_CONSTANT float MOST_BEND = 0.8f; // the tangent of the angle at its rim

// Wet is what fluid is near, where it fills so much of the space of the kernel. Seconds in which solids get wet, and dry.
SHARED_CONSTANT float WET_FILLING = 0.15f;
SHARED_CONSTANT float WETTING_TIME = 0.1f;
SHARED_CONSTANT float DRYING_TIME = 1.5f;

// What makes progress in a scene.
SHARED_CONSTANT uint PROGRESS_MELTING = 1u;
SHARED_CONSTANT uint PROGRESS_DAMAGE = 2u;
SHARED_CONSTANT uint PROGRESS_FRONT = 4u;

struct SolidSplatParams {
    uint progress;    // PROGRESS_*, by bits
    float blend_time; // s, in which what was freed grows into its ball
    float latent_heat[MAX_MATERIALS]; // J/kg; 0 where it does not melt
    float front_time[MAX_MATERIALS];  // s, in which a front crosses a spacing; 0 where there is none
    vec3 color[MAX_MATERIALS];        // linear RGB, of the solid
    uint is_sand[MAX_MATERIALS];      // 1: the wind moves it, and a sheet may cover it (sand_surface.h)
    float wet_albedo[MAX_MATERIALS];  // by which its color is multiplied where it is wet
};

struct SolidSplatPush {
    float time;      // s, of the frame
    float seconds;   // since the frame before
    uint first_disc; // where the particles' discs begin
    uint hosted;     // surface splats
    uint first_hosted; // and their first disc
};

// What is kept of a solid particle from frame to frame, by id.
struct KeptOfSolid {
    float wetness; // 0 .. 1
    float filling; // c in the first frame; 0 before
    uint changed;  // 1: c was another in the frame before, or there was fluid
};

// A surface splat. Its place and normal are those of the start, in the frame of its hosts: the axes are the ways from the first
// host to the two others and, perpendicular to them, their cross product over d.
struct HostedSplat {
    uvec3 host;  // ids
    vec3 weight; // of each in the mean, 1 in all
    vec3 offset; // from the first host
    vec3 normal; // of any length
    vec3 edge;   // at a sharp edge of the solid: the way along the disc to it, of length 1 in space; else 0
    float edge_distance; // m, to that edge; NO_EDGE without one
    vec3 color;  // linear RGB
    float radius; // m
    float wet_albedo;
    float span; // m, the longest way between two of its hosts at the start
    float filling; // c where it lay in the first frame; 0 before
    float wetness; // 0 .. 1
    float cover;   // how much it keeps particle splats below itself, 0 .. 1
};

// 0 .. 1, steady and without corners (Hermite), of x from low to high.
SHARED_FUNCTION float smooth_ramp(float low, float high, float x)
{
    float t = (x - low) / (high - low);
    t = t < 0.0f ? 0.0f : (t > 1.0f ? 1.0f : t);
    return t * t * (3.0f - 2.0f * t);
}

// Of a front that arrives at release_time and takes `duration` seconds to cross the particle's cell.
SHARED_FUNCTION float front_progress(float release_time, float time, float duration)
{
    float left = release_time - time;
    return left <= 0.0f ? 1.0f : (left < duration ? 1.0f - left / duration : 0.0f);
}

// How deep below a flat surface the space is filled so far, in spacings; negative outside. Of what a plane at a distance z cuts off
// from Wendland's kernel there is T = u^6 (7/2 - 9/2 u + 3/2 u^2), u = 1 - z / R: solved for u by Newton's method.
SHARED_FUNCTION float depth_below_surface(float filling)
{
    bool inside = filling > 0.5f;
    float missing = inside ? 1.0f - filling : filling;
    missing = missing < 1e-4f ? 1e-4f : missing;
    float u = 1.0f;
    for (int i = 0; i < 6; ++i) {
        float u5 = u * u * u * u * u;
        float rest = u5 * u * (3.5f + u * (1.5f * u - 4.5f)) - missing;
        u -= rest / (u5 * (21.0f + u * (12.0f * u - 31.5f)));
    }
    return (inside ? 1.0f - u : u - 1.0f) * SURFACE_SUPPORT;
}

SHARED_END
#endif
