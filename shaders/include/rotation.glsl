// Rotations as quaternions (xyz, w). C++ twin: glm's.
#ifndef ROTATION_GLSL
#define ROTATION_GLSL

vec4 quaternion_product(vec4 a, vec4 b)
{
    return vec4(a.w * b.xyz + b.w * a.xyz + cross(a.xyz, b.xyz), a.w * b.w - dot(a.xyz, b.xyz));
}

vec3 rotated(vec4 q, vec3 v)
{
    vec3 t = 2.0 * cross(q.xyz, v);
    return v + q.w * t + cross(q.xyz, t);
}

// The orientation after turning at an angular velocity w (rad/s) for some seconds.
vec4 turned(vec4 q, vec3 w, float seconds)
{
    float speed = length(w);
    float half_angle = 0.5 * seconds * speed;
    vec3 axis_part = speed > 0.0 ? w * (sin(half_angle) / speed) : vec3(0.0);
    return normalize(quaternion_product(vec4(axis_part, cos(half_angle)), q));
}

#endif
