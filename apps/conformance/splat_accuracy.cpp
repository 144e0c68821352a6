#include "conformance/splat_accuracy.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/glm.hpp>

#include "conformance/ray_cast.h"
#include "gpu/commands.h"
#include "render/disc_buffers.h"
#include "render/renderer.h"

namespace meltpoint::conformance {

namespace {

constexpr std::uint32_t splats = 20'000;
constexpr std::uint32_t pixels = 512;
constexpr float eye_distance = 3.0f;
constexpr float field_of_view = 40.0f;

/// The linear value of an 8-bit sRGB one (IEC 61966-2-1).
double linear(std::uint8_t value)
{
    const double c = value / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// Points of the golden angle on the unit sphere (Vogel 1979): evenly spread without any randomness.
std::vector<glm::vec4> fibonacci_points()
{
    std::vector<glm::vec4> points;
    for (std::uint32_t i = 0; i < splats; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / splats;
        const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const double r = std::sqrt(1.0 - z * z);
        points.emplace_back(r * std::cos(angle), r * std::sin(angle), z, 0.0);
    }
    return points;
}

} // namespace

SplatAccuracy measure_splats(const gpu::Context& context)
{
    const double radius = std::sqrt(4.0 * std::numbers::pi / splats);
    const std::vector<glm::vec4> normal = fibonacci_points();
    std::vector<glm::vec4> position_radius = normal;
    for (glm::vec4& disc : position_radius) {
        disc.w = static_cast<float>(radius);
    }
    const render::DiscBuffers discs(context, position_radius, normal, std::vector(splats, glm::vec4(1.0f)));

    render::FrameSettings settings;
    settings.camera =
        render::perspective_camera({0.0f, 0.0f, eye_distance}, {}, {0.0f, 1.0f, 0.0f}, field_of_view, 1.0f, 0.1f);
    settings.color_mode = shared::COLOR_NORMAL;
    render::Renderer renderer(context, pixels, pixels, 1);
    gpu::Commands commands(context);
    commands.begin();
    renderer.draw(commands, {.settings = settings, .particles = std::nullopt, .discs = discs.view()});
    commands.submit();
    commands.wait();
    const Image image = renderer.capture();
    const std::vector<float> distances = renderer.capture_distance();

    ray_cast::Camera camera;
    camera.eye = {0.0, 0.0, eye_distance};
    camera.half_height = std::tan(0.5 * glm::radians(static_cast<double>(field_of_view)));
    SplatAccuracy result{.splats = splats, .pixels = pixels};
    result.expected_offset = std::sqrt(1.0 + radius * radius) - 1.0;
    for (std::uint32_t y = 0; y < pixels; ++y) {
        for (std::uint32_t x = 0; x < pixels; ++x) {
            const ray_cast::Ray ray = camera.ray(x + 0.5, y + 0.5, pixels, pixels);
            const ray_cast::Hit hit = ray_cast::sphere(camera, ray, {}, 1.0);
            const std::size_t at = std::size_t{y} * pixels + x;
            const auto distance = static_cast<double>(distances[at]);
            const bool visible = std::isfinite(distance);
            result.inside += hit ? 1 : 0;
            result.holes += hit && !visible ? 1 : 0;
            result.spill += !hit && visible ? 1 : 0;
            if (visible) {
                const double offset = std::abs(glm::length(ray.origin + distance * ray.direction) - 1.0);
                result.worst_offset = std::max(result.worst_offset, offset);
            }
            if (hit && visible) {
                const std::uint8_t* color = &image.rgba[4 * at];
                const glm::dvec3 seen = 2.0 * glm::dvec3(linear(color[0]), linear(color[1]), linear(color[2])) - 1.0;
                const double cosine = glm::dot(glm::normalize(seen), ray.origin + *hit * ray.direction);
                result.normal_error += glm::degrees(std::acos(std::min(cosine, 1.0)));
            }
        }
    }
    result.normal_error /= result.inside - result.holes;
    return result;
}

} // namespace meltpoint::conformance
