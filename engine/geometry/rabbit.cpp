// A rabbit to melt: ellipsoids joined by a smooth minimum, polygonized at load time.

#include "geometry/rabbit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "geometry/implicit_surface.h"

namespace meltpoint {

namespace {

struct Ellipsoid {
    glm::dvec3 center;
    glm::dvec3 radii;
    double tilt;  ///< degrees about z: lifts what points along x
    double blend; ///< width over which it melts into what is listed before it
};

/// Parts with z above zero are on both sides: the rabbit is its own mirror image.
constexpr std::array<Ellipsoid, 14> parts = {{
    {{-0.12, 0.66, 0.0}, {0.74, 0.56, 0.52}, 12.0, 0.0},      // body
    {{0.36, 0.86, 0.0}, {0.36, 0.50, 0.37}, 0.0, 0.16},       // chest
    {{-0.34, 0.42, 0.34}, {0.42, 0.40, 0.24}, 0.0, 0.10},     // haunch
    {{-0.08, 0.11, 0.42}, {0.42, 0.11, 0.15}, 0.0, 0.06},     // hind foot
    {{0.46, 0.44, 0.19}, {0.14, 0.42, 0.13}, -6.0, 0.08},     // foreleg
    {{0.58, 0.10, 0.19}, {0.20, 0.10, 0.12}, 0.0, 0.06},      // forepaw
    {{-0.88, 0.50, 0.0}, {0.19, 0.18, 0.18}, 0.0, 0.05},      // tail
    {{0.60, 1.40, 0.0}, {0.36, 0.31, 0.30}, -10.0, 0.14},     // head
    {{0.86, 1.30, 0.0}, {0.19, 0.16, 0.17}, 0.0, 0.10},       // muzzle
    {{0.80, 1.27, 0.14}, {0.15, 0.13, 0.12}, 0.0, 0.06},      // cheek
    {{1.045, 1.345, 0.0}, {0.035, 0.030, 0.045}, 0.0, 0.03},  // nose
    {{0.775, 1.505, 0.21}, {0.065, 0.065, 0.05}, 0.0, 0.015}, // eye
    {{0.28, 1.86, 0.17}, {0.46, 0.13, 0.085}, 122.0, 0.06},   // ear
    {{0.42, 1.62, 0.14}, {0.16, 0.12, 0.10}, 122.0, 0.08},    // root of the ear
}};

/// About the distance to an ellipsoid (Quilez 2008): exact on its surface, to first order near it.
double distance_to(const Ellipsoid& part, const glm::dvec3& x)
{
    const double angle = glm::radians(part.tilt);
    const glm::dvec3 v = x - part.center;
    const glm::dvec3 local(std::cos(angle) * v.x + std::sin(angle) * v.y,
                           -std::sin(angle) * v.x + std::cos(angle) * v.y, v.z);
    const double scaled = glm::length(local / part.radii);
    const double slope = glm::length(local / (part.radii * part.radii));
    return slope > 0.0 ? scaled * (scaled - 1.0) / slope : -std::min({part.radii.x, part.radii.y, part.radii.z});
}

/// The smaller of two numbers; where they differ by less than `width`, a bit less than that, without a crease.
double smooth_min(double a, double b, double width)
{
    const double overlap = std::max(width - std::abs(a - b), 0.0);
    return std::min(a, b) - (width > 0.0 ? overlap * overlap / (4.0 * width) : 0.0);
}

double rabbit_distance(const glm::dvec3& x)
{
    const glm::dvec3 mirrored(x.x, x.y, std::abs(x.z));
    double distance = distance_to(parts[0], mirrored);
    for (std::size_t i = 1; i < parts.size(); ++i) {
        distance = smooth_min(distance, distance_to(parts[i], mirrored), parts[i].blend);
    }
    return distance;
}

} // namespace

TriangleMesh rabbit()
{
    constexpr double cell = 0.028;
    const Aabb box{{-1.2f, -0.15f, -0.75f}, {1.2f, 2.45f, 0.75f}};
    TriangleMesh mesh = polygonize(rabbit_distance, box, cell);
    const float ground = bounds(mesh).min.y;
    for (glm::vec3& position : mesh.positions) {
        position.y -= ground;
    }
    return mesh;
}

} // namespace meltpoint
