// Visibility of the box's edges.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/render_params.h"

layout(location = 0) out uint out_surface;

void main() { out_surface = SURFACE_LINE << SURFACE_SHIFT; }
