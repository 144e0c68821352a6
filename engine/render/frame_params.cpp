#include "render/frame_params.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace meltpoint::render {

namespace {

constexpr float line_width = 1.3f; // pixels

void check_settings(const FrameSettings& settings)
{
    if (!(settings.splat_radius > 0.0f) || !std::isfinite(settings.splat_radius)) {
        throw input_error("the splat radius is {} m, but must be positive", settings.splat_radius);
    }
    const float light = glm::length(settings.light_direction);
    if (!(light > 0.0f) || !std::isfinite(light)) {
        throw input_error("the light direction has length {}, but must point somewhere", light);
    }
    const glm::vec2 range = settings.color_range;
    if (!std::isfinite(range.x) || !std::isfinite(range.y) || range.x == range.y) {
        throw input_error("the color range is {} to {}, but must be finite and not empty", range.x, range.y);
    }
    if (settings.color_mode > shared::COLOR_NORMAL) {
        throw input_error("there is no color mode {}", settings.color_mode);
    }
}

/// An orthographic camera in the light that sees all of the bounds, spheres at their rim included.
Camera light_camera(const Aabb& bounds, float margin, const glm::vec3& direction)
{
    const float radius = 0.5f * glm::length(bounds.size()) + margin;
    const glm::vec3 eye = bounds.center() + 2.0f * radius * direction;
    return orthographic_camera(eye, bounds.center(), {0.0f, 0.0f, 1.0f}, 2.0f * radius, 1.0f, radius, 3.0f * radius);
}

} // namespace

shared::RenderParams frame_params(const FrameSettings& settings, std::uint32_t width, std::uint32_t height,
                                  std::uint32_t samples, std::uint32_t shadow_size)
{
    check_settings(settings);
    shared::RenderParams params{};
    params.camera = splat_camera(settings.camera, width * samples, height * samples);
    params.view_to_world = glm::inverse(settings.camera.view);
    params.light_direction = glm::normalize(settings.light_direction);
    params.splat_radius = settings.splat_radius;
    params.background = settings.background;
    params.color_mode = settings.color_mode;
    params.color_range = settings.color_range;
    params.lit = settings.lit ? 1 : 0;
    if (settings.lit && !settings.bounds.empty()) {
        const Camera light = light_camera(settings.bounds, settings.splat_radius, params.light_direction);
        params.light = splat_camera(light, shadow_size, shadow_size);
        params.shadows = 1;
    }
    if (settings.floor) {
        params.floor_color = settings.floor->color;
        params.floor_height = settings.floor->height;
        params.floor_center = settings.floor->center;
        params.floor_extent = settings.floor->extent;
        params.floor_grid = settings.floor->grid;
    }
    params.box_min = settings.bounds.min;
    params.box_max = settings.bounds.max;
    params.line_width = line_width * static_cast<float>(samples);
    params.line_color = settings.box_color;
    params.samples = samples;
    std::copy(settings.material_color.begin(), settings.material_color.end(), std::begin(params.material_color));
    std::copy(settings.solid_color.begin(), settings.solid_color.end(), std::begin(params.solid_color));
    std::copy(settings.rest_density.begin(), settings.rest_density.end(), std::begin(params.rest_density));
    return params;
}

} // namespace meltpoint::render
