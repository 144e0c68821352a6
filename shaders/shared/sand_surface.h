// The surface of loose sand in pictures. Sand stands in columns that are seen from above (shared/wind.h), and their tops are a
// spacing apart in height: a staircase. The picture shows what it stands for, a sheet over the columns, in four passes a frame:
//
// 1. Each column has a height: that of its top particle, less what the wind has taken of that one. It follows at once at the
//    start, and then within some frames, so that a particle that lands or leaves is not seen as a step.
// 2. A plane is fitted to the columns around each, by least squares, and how far they are off it is kept.
// 3. The sheet's corners lie between texels. At each, the planes around are averaged, and those that fit badly count for little:
//    a window that a crest divides loses to the windows on its sides, so slopes come out smooth and crests sharp (after Kuwahara,
//    Hachimura, Eiho & Kinoshita 1976, as a weighted mean of all windows).
// 4. Solid sand close below the sheet has no splats of its own, and sand in the air is a puff of specks that fades in over the sheet.
//
// Where the ground is too steep or too rough for a sheet, there is none, and sand looks as other solids do (solid_splats.h).
#ifndef MELTPOINT_SHARED_SAND_SURFACE_H
#define MELTPOINT_SHARED_SAND_SURFACE_H
#include "prelude.h"

SHARED_BEGIN

SHARED_CONSTANT int SHEET_REACH = 4;          // texels on each side, to which a plane is fitted, and that a corner averages
SHARED_CONSTANT float SHEET_ROUNDING = 1e-3f; // of a fit's weight: it is level where its columns do not say how it slopes
SHARED_CONSTANT float SHEET_NOISE = 0.25f;    // spacings: fits that are off by less are equally good

// s, in which a column's height follows by 63 %, and in which a sheet comes and goes.
SHARED_CONSTANT float COLUMN_TIME = 0.12f;
SHARED_CONSTANT float SHEET_TIME = 0.25f;

// A sheet is there up to this slope, and where columns are off their planes by up to so many spacings, root mean square.
SHARED_CONSTANT float STEEPEST_SHEET = 1.1f;
SHARED_CONSTANT float ROUGHEST_SHEET = 0.8f;

SHARED_CONSTANT float COVERED_BELOW = 3.0f; // spacings below the sheet, down to which sand has no splats: farther down overhangs end

// Thickness of the sheet, in spacings, at which the first grains cover the floor, and at which they cover all of it.
SHARED_CONSTANT float SHEET_FROM = 0.03f;
SHARED_CONSTANT float SHEET_FULLY = 0.5f;

SHARED_CONSTANT float GRAINS_A_SPACING = 10.0f; // grains of sand as they are seen
SHARED_CONSTANT float GRAIN_CONTRAST = 0.05f;   // by how much their colors differ from the mean

// A puff, in radii of a particle, and in spacings the height above the sheet at which it has reached that size.
SHARED_CONSTANT float PUFF_RADIUS = 2.5f;
SHARED_CONSTANT float PUFF_HEIGHT = 4.0f;
SHARED_CONSTANT float SPECKS_A_RADIUS = 12.0f; // specks side by side
SHARED_CONSTANT float PUFF_COVERAGE = 0.20f;   // in its middle: share of its specks that are there

// Of two whole numbers and a seed, 0 to 1, as random as they are (PCG 3D; Jarzynski & Olano 2020).
SHARED_FUNCTION float grain_share(uint x, uint y, uint seed)
{
    uint a = x * 1664525u + 1013904223u;
    uint b = y * 1664525u + 1013904223u;
    uint c = seed * 1664525u + 1013904223u;
    a += b * c;
    b += c * a;
    c += a * b;
    a ^= a >> 16u;
    b ^= b >> 16u;
    c ^= c >> 16u;
    a += b * c;
    return float(a >> 8u) / 16777216.0f;
}

struct SandPush {
    float seconds; // since the frame before
    uint first;    // 1: there was none
};

SHARED_END
#endif
