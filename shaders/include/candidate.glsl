// Loading a candidate, all components of one buffer at once. Software devices fetch texels many times faster than words of
// storage buffers, of which each component of each invocation is a branch of its own; GPUs prefer storage buffers. So a
// shader binds both views of a buffer, and reads through load_candidate(NAME, index): NAME[index] or NAME_texels.
#ifndef CANDIDATE_GLSL
#define CANDIDATE_GLSL
#extension GL_EXT_samplerless_texture_functions : require

layout(constant_id = 3) const bool FETCH_TEXELS = false;

#define load_candidate(buffer, index) (FETCH_TEXELS ? texelFetch(buffer##_texels, int(index)) : vec4(buffer[index]))

#endif
