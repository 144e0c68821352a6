#include "render/camera.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace meltpoint::render {

namespace {

bool finite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check_aspect(float aspect)
{
    if (!(aspect > 0.0f) || !std::isfinite(aspect)) {
        throw input_error("a camera's aspect ratio is {}, but must be positive", aspect);
    }
}

void check_field_of_view(float degrees)
{
    if (!(degrees > 0.0f && degrees < 180.0f)) {
        throw input_error("a camera's field of view is {} degrees, but must lie between 0 and 180", degrees);
    }
}

} // namespace

glm::mat4 look_at(const glm::vec3& eye, const glm::vec3& target, const glm::vec3& up)
{
    if (!finite(eye) || !finite(target) || !finite(up)) {
        throw input_error("a camera's eye, target or up direction is not finite");
    }
    const glm::vec3 gaze = target - eye;
    if (!(glm::length(gaze) > 0.0f)) {
        throw input_error("a camera's eye and target are the same point ({}, {}, {})", eye.x, eye.y, eye.z);
    }
    const glm::vec3 back = -glm::normalize(gaze);
    glm::vec3 right = glm::cross(up, back);
    if (glm::length(right) < 1e-5f * std::max(glm::length(up), 1e-30f)) {
        right = glm::cross(std::abs(back.z) < 0.9f ? glm::vec3(0.0f, 0.0f, -1.0f) : glm::vec3(0.0f, 1.0f, 0.0f), back);
    }
    right = glm::normalize(right);
    const glm::vec3 top = glm::cross(back, right);

    glm::mat4 view(1.0f);
    for (int axis = 0; axis < 3; ++axis) {
        view[axis] = glm::vec4(right[axis], top[axis], back[axis], 0.0f);
    }
    view[3] = glm::vec4(-glm::dot(right, eye), -glm::dot(top, eye), -glm::dot(back, eye), 1.0f);
    return view;
}

Camera perspective_camera(const glm::vec3& eye, const glm::vec3& target, const glm::vec3& up,
                          float vertical_fov_degrees, float aspect, float near_distance, float far_distance)
{
    check_aspect(aspect);
    check_field_of_view(vertical_fov_degrees);
    if (!(near_distance > 0.0f && near_distance < far_distance)) {
        throw input_error("a perspective camera's near and far distances are {} and {} m, but must be 0 < near < far",
                          near_distance, far_distance);
    }
    const float focal = 1.0f / std::tan(0.5f * glm::radians(vertical_fov_degrees));
    const float near_over_range = std::isinf(far_distance) ? 0.0f : near_distance / (far_distance - near_distance);

    Camera camera{look_at(eye, target, up), glm::mat4(0.0f), near_distance, far_distance, false};
    camera.projection[0][0] = focal / aspect;
    camera.projection[1][1] = -focal;
    camera.projection[2][2] = near_over_range;
    camera.projection[2][3] = -1.0f;
    camera.projection[3][2] = near_distance * (1.0f + near_over_range);
    return camera;
}

Camera orthographic_camera(const glm::vec3& eye, const glm::vec3& target, const glm::vec3& up, float view_height,
                           float aspect, float near_distance, float far_distance)
{
    check_aspect(aspect);
    if (!(view_height > 0.0f) || !std::isfinite(view_height)) {
        throw input_error("an orthographic camera's view height is {} m, but must be positive", view_height);
    }
    if (!(near_distance < far_distance) || !std::isfinite(near_distance) || !std::isfinite(far_distance)) {
        throw input_error("an orthographic camera's near and far distances are {} and {} m, but must be near < far, "
                          "both finite",
                          near_distance, far_distance);
    }
    Camera camera{look_at(eye, target, up), glm::mat4(1.0f), near_distance, far_distance, true};
    camera.projection[0][0] = 2.0f / (view_height * aspect);
    camera.projection[1][1] = -2.0f / view_height;
    camera.projection[2][2] = 1.0f / (far_distance - near_distance);
    camera.projection[3][2] = far_distance / (far_distance - near_distance);
    return camera;
}

float framing_distance(const Aabb& box, const glm::vec3& target, const glm::vec3& direction, const glm::vec3& up,
                       float vertical_fov_degrees, float aspect)
{
    check_aspect(aspect);
    check_field_of_view(vertical_fov_degrees);
    const glm::mat4 view = look_at(target - glm::normalize(direction), target, up);
    const float tan_y = std::tan(0.5f * glm::radians(vertical_fov_degrees));
    const float tan_x = tan_y * aspect;
    float distance = 0.0f;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1u) != 0 ? box.max.x : box.min.x, (corner & 2u) != 0 ? box.max.y : box.min.y,
                          (corner & 4u) != 0 ? box.max.z : box.min.z);
        const glm::vec4 q = view * glm::vec4(p, 1.0f); // seen from one meter before the target
        distance = std::max({distance, std::abs(q.x) / tan_x + q.z + 1.0f, std::abs(q.y) / tan_y + q.z + 1.0f});
    }
    return distance;
}

shared::SplatCamera splat_camera(const Camera& camera, std::uint32_t width, std::uint32_t height)
{
    const glm::mat4& p = camera.projection;
    shared::SplatCamera splat{};
    splat.view = camera.view;
    splat.plane_scale = {1.0f / p[0][0], 1.0f / p[1][1]};
    // ndc = p00 x/d - p20 with perspective, p00 x + p30 without.
    splat.plane_offset = camera.orthographic ? -glm::vec2(p[3][0], p[3][1]) * splat.plane_scale
                                             : glm::vec2(p[2][0], p[2][1]) * splat.plane_scale;
    splat.depth_map = camera.orthographic ? glm::vec2(p[3][2], -p[2][2]) : glm::vec2(-p[2][2], p[3][2]);
    splat.pixel = {2.0f / static_cast<float>(width), 2.0f / static_cast<float>(height)};
    splat.near_distance = camera.near_distance;
    splat.far_distance = camera.far_distance;
    splat.orthographic = camera.orthographic ? 1u : 0u;
    return splat;
}

} // namespace meltpoint::render
