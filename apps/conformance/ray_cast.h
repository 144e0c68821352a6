#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include <glm/glm.hpp>

/// Ray casts in double precision that share no code with the renderer: what splat pictures are held against.
namespace meltpoint::ray_cast {

struct Ray {
    glm::dvec3 origin;
    glm::dvec3 direction; ///< scaled so that its parameter is the distance along the view axis
};

/// A camera at `eye` that looks along -z with y up.
struct Camera {
    glm::dvec3 eye{0.0};
    bool orthographic = false;
    double half_height = 1.0; ///< of the picture: at distance 1, or everywhere when orthographic
    double near = 0.1;
    double far = std::numeric_limits<double>::infinity();

    /// Through the point (x, y) of a picture, in pixels from its upper left corner.
    [[nodiscard]] Ray ray(double x, double y, std::uint32_t width, std::uint32_t height) const
    {
        const double scale = 2.0 * half_height / height;
        const glm::dvec3 plane((x - 0.5 * width) * scale, (0.5 * height - y) * scale, 0.0);
        const glm::dvec3 forward(0.0, 0.0, -1.0);
        return orthographic ? Ray{eye + plane, forward} : Ray{eye, plane + forward};
    }

    [[nodiscard]] bool sees(double distance) const { return distance >= near && distance <= far; }
};

/// Distance along the view axis of the nearest visible hit; nothing for a miss.
using Hit = std::optional<double>;

inline Hit sphere(const Camera& camera, const Ray& ray, const glm::dvec3& center, double radius)
{
    const glm::dvec3 q = ray.origin - center;
    const double a = glm::dot(ray.direction, ray.direction);
    const double b = glm::dot(ray.direction, q);
    const double discriminant = b * b - a * (glm::dot(q, q) - radius * radius);
    if (discriminant < 0.0) {
        return std::nullopt;
    }
    for (const double root : {-std::sqrt(discriminant), std::sqrt(discriminant)}) {
        const double t = (root - b) / a;
        if (t >= camera.near) {
            return camera.sees(t) ? Hit(t) : std::nullopt;
        }
    }
    return std::nullopt;
}

inline Hit disc(const Camera& camera, const Ray& ray, const glm::dvec3& center, const glm::dvec3& normal, double radius)
{
    const double t = glm::dot(center - ray.origin, normal) / glm::dot(ray.direction, normal);
    const bool inside = glm::length(ray.origin + t * ray.direction - center) <= radius; // false for NaN
    return inside && camera.sees(t) ? Hit(t) : std::nullopt;
}

} // namespace meltpoint::ray_cast
