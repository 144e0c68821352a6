// The index of this invocation in the dispatch, whether the host spread the workgroups over one axis or two (the number of
// workgroups along an axis is limited, to 65,535 on many devices).
#ifndef INVOCATION_GLSL
#define INVOCATION_GLSL

const uint WORKGROUP_SIZE = 64u;

uint workgroup_index() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

uint invocation_index() { return workgroup_index() * gl_WorkGroupSize.x + gl_LocalInvocationIndex; }

#endif
