// The workgroup's size, and the index of this invocation in the dispatch, whether the host spread the workgroups over one
// axis or two (the number of workgroups along an axis is limited, to 65,535 on many devices). A shader that wants another
// size defines WORKGROUP_SIZE before it includes this.
#ifndef INVOCATION_GLSL
#define INVOCATION_GLSL

#ifndef WORKGROUP_SIZE
#define WORKGROUP_SIZE 64u
#endif

layout(local_size_x = WORKGROUP_SIZE) in; // before the first use of gl_WorkGroupSize, which otherwise is 1

uint workgroup_index() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

uint invocation_index() { return workgroup_index() * WORKGROUP_SIZE + gl_LocalInvocationIndex; }

#endif
