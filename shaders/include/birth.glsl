// When and where those who are called up are born. Include it after the declaration of `params`.
#ifndef BIRTH_GLSL
#define BIRTH_GLSL
#include "shared/particle_state.h"

bool is_due(uint attributes, float birth, float time) { return (attributes & FLAG_DUE) != 0u && birth <= time; }

// It comes out of its emitter between two steps, and has been moving since; at most for a step.
vec3 birth_position(vec3 place, vec3 velocity, float birth, float time)
{
    return place + min(time - birth, params.dt) * velocity;
}

#endif
