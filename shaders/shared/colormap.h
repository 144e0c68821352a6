// The colormap of the data modes, dark violet through teal to yellow, for shaders and for the legend alike.
//
// A path through OKLab (Ottosson 2020): lightness rises evenly from 0.27 to 0.91 and hue turns from 292 to 102 degrees,
// so that equal steps of the value look equally large and the order survives in gray. Square roots of linear RGB,
// fitted by polynomials of degree 5: the steps of lightness are within 10 % of each other.
#ifndef MELTPOINT_SHARED_COLORMAP_H
#define MELTPOINT_SHARED_COLORMAP_H
#include "prelude.h"

SHARED_BEGIN

// Linear RGB of t in [0, 1]; values outside take the color of the nearer end.
SHARED_FUNCTION vec3 colormap(float t)
{
    t = t > 0.0f ? (t < 1.0f ? t : 1.0f) : 0.0f; // also takes a NaN to 0
    vec3 root = vec3(-10.9703f, -0.5237f, 2.5939f);
    root = root * t + vec3(25.6021f, 0.2058f, -5.3146f);
    root = root * t + vec3(-17.1189f, 0.1220f, 2.8315f);
    root = root * t + vec3(3.4831f, 0.3360f, -1.1124f);
    root = root * t + vec3(-0.1922f, 0.6466f, 1.0245f);
    root = root * t + vec3(0.1620f, 0.0915f, 0.2912f);
    return root * root;
}

// Density below the rest density: a color that the map does not have (the paper's figure 3).
SHARED_FUNCTION vec3 below_rest_color() { return vec3(0.80f, 0.02f, 0.62f); }

SHARED_END
#endif
