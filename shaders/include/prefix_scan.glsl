// How the passes of a prefix scan divide the elements: a block of consecutive elements a workgroup, and of these a run of
// ELEMENTS consecutive ones an invocation.
#ifndef PREFIX_SCAN_GLSL
#define PREFIX_SCAN_GLSL

#include "include/invocation.glsl"
#include "include/workgroup_scan.glsl"

layout(constant_id = 0) const uint ELEMENTS = 16u;

const uint BLOCK = ELEMENTS * WORKGROUP_SIZE;

layout(push_constant) uniform Push { uint count; };

#endif
