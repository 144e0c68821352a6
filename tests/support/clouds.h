#pragma once

// Clouds of points on shapes that are known exactly.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/random.h"
#include "geometry/builtin_meshes.h"
#include "geometry/point_cloud.h"
#include "geometry/surface_sampling.h"

namespace meltpoint::test {

/// Points in a spiral on the unit sphere, each for the same area (Gonzalez 2010), below a height.
inline PointCloud fibonacci_sphere(std::size_t count, float below = 2.0f)
{
    PointCloud cloud;
    for (std::size_t i = 0; i < count; ++i) {
        const double y = 1.0 - (2.0 * double(i) + 1.0) / double(count);
        const double angle = double(i) * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const double radius = std::sqrt(1.0 - y * y);
        const glm::vec3 position(radius * std::cos(angle), y, radius * std::sin(angle));
        if (position.y < below) {
            cloud.positions.push_back(position);
        }
    }
    return cloud;
}

/// Points on a built-in mesh, without anything else.
inline PointCloud points_on(std::string_view mesh, std::size_t count, SurfaceMethod method, std::uint64_t seed = 1)
{
    PointCloud cloud;
    cloud.positions = sample_surface(builtin_mesh(mesh), {method, PointCount{count}, seed}).cloud.positions;
    return cloud;
}

/// The built-in torus' normal at a point on it or near.
inline glm::vec3 torus_normal(const glm::vec3& point)
{
    const glm::vec3 ring = glm::normalize(glm::vec3(point.x, 0.0f, point.z));
    return glm::normalize(point - ring);
}

/// As the text of a file of points: x y z a line, and the normals where there are any.
inline std::string xyz_of(const PointCloud& cloud)
{
    std::string text;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const glm::vec3& x = cloud.positions[i];
        text += fmt::format("{} {} {}", x.x, x.y, x.z);
        if (!cloud.normals.empty()) {
            const glm::vec3& n = cloud.normals[i];
            text += fmt::format(" {} {} {}", n.x, n.y, n.z);
        }
        text += '\n';
    }
    return text;
}

/// Points all over the unit sphere with normals that face inward.
inline PointCloud inward_sphere(std::size_t count)
{
    PointCloud cloud = fibonacci_sphere(count);
    for (const glm::vec3& x : cloud.positions) {
        cloud.normals.push_back(-x);
    }
    return cloud;
}

/// Adds noise of the given length to every point, in all directions.
inline void shake(PointCloud& cloud, double length, std::uint64_t seed = 1)
{
    Random random(seed);
    for (glm::vec3& position : cloud.positions) {
        for (int axis = 0; axis < 3; ++axis) {
            position[axis] += static_cast<float>(length * (2.0 * random.uniform() - 1.0));
        }
    }
}

} // namespace meltpoint::test
