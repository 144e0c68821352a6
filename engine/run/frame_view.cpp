#include "run/frame_view.h"

#include <algorithm>

#include "render/camera.h"
#include "run/plane_scene.h"
#include "scene/materials.h"

namespace meltpoint {

namespace {

constexpr float sound_per_speed = 10.0f; // as in fluid_settings: the speed expected of the scene is c0 / 10

render::Camera scene_camera(const Scene& scene)
{
    const CameraSettings& camera = scene.camera;
    const Aabb domain{scene.domain.min, scene.domain.max};
    const glm::vec3 size = domain.size();
    const float diagonal = glm::length(size);
    const float aspect = static_cast<float>(scene.render.width) / static_cast<float>(scene.render.height);
    const bool flat = scene.domain.dimensions == 2;
    const glm::vec3 middle = domain.center() - glm::vec3(0.0f, flat ? 0.0f : 0.2f * size.y, 0.0f);
    const glm::vec3 target = camera.target.value_or(middle);

    if (camera.projection == Projection::Orthographic || (camera.projection == Projection::Auto && flat)) {
        const glm::vec3 eye = camera.eye.value_or(target + glm::vec3(0.0f, 0.0f, diagonal));
        const float view_height = camera.view_height.value_or(1.1f * std::max(size.y, size.x / aspect));
        const float reach = glm::length(eye - target) + 2.0f * diagonal;
        return render::orthographic_camera(eye, target, camera.up, view_height, aspect, 1e-3f * diagonal, reach);
    }
    const glm::vec3 direction = flat ? glm::vec3(0.0f, 0.0f, -1.0f) : glm::normalize(glm::vec3(-0.55f, -0.45f, -1.0f));
    const glm::vec3 eye =
        camera.eye.value_or(target - direction * render::framing_distance(domain, target, direction, camera.up,
                                                                          camera.field_of_view, aspect));
    return render::perspective_camera(eye, target, camera.up, camera.field_of_view, aspect, 1e-3f * diagonal);
}

std::uint32_t color_mode(ColorMode mode)
{
    switch (mode) {
    case ColorMode::Density:
        return shared::COLOR_DENSITY;
    case ColorMode::Speed:
        return shared::COLOR_SPEED;
    case ColorMode::Pressure:
        return shared::COLOR_PRESSURE;
    case ColorMode::Material:
        break;
    }
    return shared::COLOR_MATERIAL;
}

/// Expected extremes of the colored quantity, from the speed expected of the scene and its heaviest fluid.
glm::vec2 color_range(const Scene& scene, const shared::SphParams& params, float rest_density)
{
    const float speed = params.speed_of_sound / sound_per_speed;
    switch (scene.render.color) {
    case ColorMode::Density:
        return {rest_density, 1.03f * rest_density};
    case ColorMode::Pressure:
        return {0.0f, 0.5f * rest_density * speed * speed};
    case ColorMode::Speed:
    case ColorMode::Material:
        break;
    }
    return {0.0f, speed};
}

} // namespace

render::FrameSettings frame_settings(const Scene& any_scene, const shared::SphParams& params)
{
    const Scene scene = in_its_dimensions(any_scene);
    render::FrameSettings settings;
    settings.camera = scene_camera(scene);
    settings.background = scene.render.background;
    settings.light_direction = scene.render.light;
    settings.bounds = {scene.domain.min, scene.domain.max};
    settings.box = scene.domain.walls || glm::any(scene.domain.periodic);
    settings.color_mode = color_mode(scene.render.color);
    settings.splat_radius = scene.render.splat_radius * scene.particles.spacing;
    settings.blend_time = scene.render.blend_time;

    const SceneMaterials materials = scene_materials(scene);
    float heaviest = 0.0f;
    for (std::size_t i = 0; i < materials.materials.size(); ++i) {
        settings.rest_density[i] = materials.materials[i].rest_density;
        settings.material_color[i] = materials.materials[i].color;
        settings.solid_color[i] = materials.materials[i].solid_color;
        heaviest = std::max(heaviest, materials.materials[i].rest_density);
    }
    settings.color_range = scene.render.color_range.value_or(color_range(scene, params, heaviest));

    if (scene.render.floor && scene.domain.dimensions == 3) {
        const glm::vec3 size = scene.domain.max - scene.domain.min;
        const glm::vec3 center = 0.5f * (scene.domain.min + scene.domain.max);
        const float width = std::max(size.x, size.z);
        settings.floor = render::Floor{.height = scene.domain.min.y,
                                       .center = {center.x, center.z},
                                       .extent = 2.5f * width,
                                       .grid = width / 10.0f};
    }
    return settings;
}

std::optional<render::Legend> frame_legend(const Scene& scene, const render::FrameSettings& settings)
{
    if (!scene.render.legend || scene.render.color == ColorMode::Material) {
        return std::nullopt;
    }
    return render::legend_for(settings.color_mode, settings.color_range, settings.background);
}

} // namespace meltpoint
