#pragma once

#include <limits>

#include <glm/glm.hpp>

#include "core/aabb.h"
#include "shared/render_params.h"

namespace meltpoint::render {

/// View space is right-handed and looks along -z. The projection is Vulkan's: y down, depth from 1 at the near plane to
/// 0 at the far plane (reversed, so that floating-point depth is about equally fine everywhere).
struct Camera {
    glm::mat4 view{1.0f};
    glm::mat4 projection{1.0f};
    float near_distance = 0.0f; ///< m along the view axis
    float far_distance = 0.0f;  ///< m, may be infinite (perspective only)
    bool orthographic = false;
};

/// World to view space. Where `up` is parallel to the direction of view, another axis takes its place. Throws Input
/// when eye and target coincide or a value is not finite.
[[nodiscard]] glm::mat4 look_at(const glm::vec3& eye, const glm::vec3& target, const glm::vec3& up);

/// Throws Input for a field of view outside (0, 180) degrees, an aspect (width / height) that is not positive, or
/// unless 0 < near < far; far may be infinite.
[[nodiscard]] Camera perspective_camera(const glm::vec3& eye, const glm::vec3& target, const glm::vec3& up,
                                        float vertical_fov_degrees, float aspect, float near_distance,
                                        float far_distance = std::numeric_limits<float>::infinity());

/// view_height: m that the picture's height shows. Throws Input unless it and aspect are positive and near < far, both
/// finite.
[[nodiscard]] Camera orthographic_camera(const glm::vec3& eye, const glm::vec3& target, const glm::vec3& up,
                                         float view_height, float aspect, float near_distance, float far_distance);

/// How far behind `target`, against `direction`, the eye of a perspective camera must stand to see the whole box.
[[nodiscard]] float framing_distance(const Aabb& box, const glm::vec3& target, const glm::vec3& direction,
                                     const glm::vec3& up, float vertical_fov_degrees, float aspect);

/// The camera as shaders need it, for a picture of width x height samples.
[[nodiscard]] shared::SplatCamera splat_camera(const Camera& camera, std::uint32_t width, std::uint32_t height);

} // namespace meltpoint::render
