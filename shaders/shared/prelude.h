// Lets one header be read by C++ and by GLSL. With scalar layout, C++ and SPIR-V agree on every offset of vec3, float,
// uint, mat4 and arrays of them. Use uint for flags, never bool: its size differs.
#ifndef MELTPOINT_SHARED_PRELUDE_H
#define MELTPOINT_SHARED_PRELUDE_H

#ifdef __cplusplus

#include <cstdint>

#include <glm/glm.hpp>

#define SHARED_BEGIN                                                                                                   \
    namespace meltpoint::shared {                                                                                      \
    using glm::mat4;                                                                                                   \
    using glm::uvec3;                                                                                                  \
    using glm::vec2;                                                                                                   \
    using glm::vec3;                                                                                                   \
    using glm::vec4;                                                                                                   \
    using uint = std::uint32_t;
#define SHARED_END }
#define SHARED_CONSTANT inline constexpr
#define SHARED_FUNCTION constexpr

#else

#extension GL_EXT_scalar_block_layout : require
#define SHARED_BEGIN
#define SHARED_END
#define SHARED_CONSTANT const
#define SHARED_FUNCTION

#endif
#endif
