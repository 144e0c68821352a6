#include "geometry/builtin_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include <fmt/ranges.h>

#include "core/error.h"
#include "geometry/rabbit.h"
#include "geometry/teapot.h"

namespace meltpoint {

namespace {

constexpr std::uint32_t teapot_resolution = 16;
constexpr std::uint32_t sphere_resolution = 64;
constexpr std::uint32_t torus_resolution = 64;
constexpr double torus_major_radius = 1.0;
constexpr double torus_minor_radius = 0.4;

TriangleMesh cube()
{
    TriangleMesh mesh;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        mesh.positions.push_back(glm::vec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1) - 0.5f);
    }
    mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    return mesh;
}

/// The cube's faces as grids, pushed out to the sphere. Grid lines at equal angles keep the triangles alike.
TriangleMesh sphere()
{
    TriangleMesh mesh;
    const auto line = [](std::uint32_t i) {
        return std::tan((2.0 * i / sphere_resolution - 1.0) * std::numbers::pi / 4.0);
    };
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        const double side = face % 2 == 0 ? 1.0 : -1.0;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const std::uint32_t stride = sphere_resolution + 1;
        for (std::uint32_t row = 0; row <= sphere_resolution; ++row) {
            for (std::uint32_t column = 0; column <= sphere_resolution; ++column) {
                glm::dvec3 point;
                point[axis] = side;
                point[(axis + 1) % 3] = line(row) * side; // mirrored with the face, so that the orientation stays
                point[(axis + 2) % 3] = line(column);
                mesh.positions.emplace_back(glm::normalize(point));
            }
        }
        for (std::uint32_t row = 0; row < sphere_resolution; ++row) {
            for (std::uint32_t column = 0; column < sphere_resolution; ++column) {
                const std::uint32_t corner = first + row * stride + column;
                mesh.triangles.emplace_back(corner, corner + stride, corner + stride + 1);
                mesh.triangles.emplace_back(corner, corner + stride + 1, corner + 1);
            }
        }
    }
    mesh = weld(mesh);
    mesh.normals = mesh.positions;
    return mesh;
}

TriangleMesh torus()
{
    TriangleMesh mesh;
    const std::uint32_t turns = 2 * torus_resolution;
    for (std::uint32_t i = 0; i < turns; ++i) {
        const double around = 2.0 * std::numbers::pi * i / turns;
        const glm::dvec3 outward(std::cos(around), 0.0, -std::sin(around));
        for (std::uint32_t j = 0; j < torus_resolution; ++j) {
            const double tube = 2.0 * std::numbers::pi * j / torus_resolution;
            const glm::dvec3 normal = std::cos(tube) * outward + glm::dvec3(0.0, std::sin(tube), 0.0);
            mesh.positions.emplace_back(torus_major_radius * outward + torus_minor_radius * normal);
            mesh.normals.emplace_back(normal);

            const std::uint32_t next_i = (i + 1) % turns * torus_resolution;
            const std::uint32_t next_j = (j + 1) % torus_resolution;
            const std::uint32_t here = i * torus_resolution;
            mesh.triangles.emplace_back(here + j, next_i + j, next_i + next_j);
            mesh.triangles.emplace_back(here + j, next_i + next_j, here + next_j);
        }
    }
    return mesh;
}

constexpr std::array<std::string_view, 5> names = {"teapot", "rabbit", "sphere", "cube", "torus"};

/// Levenshtein (1966): insertions, deletions and replacements that turn one word into the other.
std::size_t edit_distance(std::string_view from, std::string_view to)
{
    std::vector<std::size_t> row(to.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < from.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < to.size(); ++j) {
            const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
        }
    }
    return row.back();
}

} // namespace

std::span<const std::string_view> builtin_mesh_names()
{
    return names;
}

TriangleMesh builtin_mesh(std::string_view name)
{
    if (name == "teapot") {
        return teapot(teapot_resolution);
    }
    if (name == "rabbit") {
        return rabbit();
    }
    if (name == "sphere") {
        return sphere();
    }
    if (name == "cube") {
        return cube();
    }
    if (name == "torus") {
        return torus();
    }
    const std::string_view shown = name.substr(0, 80);
    const std::string_view nearest = *std::min_element(
        names.begin(), names.end(), [&](auto a, auto b) { return edit_distance(shown, a) < edit_distance(shown, b); });
    throw input_error("there is no built-in mesh \"{}\"; did you mean \"{}\"? There are {}", shown, nearest,
                      fmt::join(names, ", "));
}

} // namespace meltpoint
