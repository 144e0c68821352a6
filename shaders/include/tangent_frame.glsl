// Two unit vectors perpendicular to a unit normal and to each other (Duff et al., "Building an Orthonormal Basis, Revisited",
// JCGT 6, 2017).
#ifndef TANGENT_FRAME_GLSL
#define TANGENT_FRAME_GLSL

void tangent_frame(vec3 n, out vec3 u, out vec3 v)
{
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    u = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    v = vec3(b, s + n.y * n.y * a, -n.y);
}

#endif
