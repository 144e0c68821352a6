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

/// A barchan, 2.4 long and 0.36 high, in a wind along x: its windward slope is gentle, its lee slope 32 degrees steep,
/// both raised cosines, and its horns point downwind. It stands on its flat bottom.
TriangleMesh dune()
{
    constexpr std::uint32_t resolution = 64;
    constexpr double windward = 1.5;
    constexpr double lee = 0.9;
    constexpr double half_width = 0.9;
    constexpr double height = 0.36;
    constexpr double horns = 0.35; // how far the flanks lie downwind
    TriangleMesh mesh;
    const std::uint32_t stride = resolution + 1;
    const auto hump = [](double way) { // ends before it is too thin to have a top and a bottom
        return 0.5 + 0.5 * std::cos(0.9 * std::numbers::pi * way);
    };
    for (const double side : {1.0, 0.0}) { // top and bottom
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (std::uint32_t row = 0; row <= resolution; ++row) {
            for (std::uint32_t column = 0; column <= resolution; ++column) {
                const double across = 2.0 * row / resolution - 1.0;
                const double along = 2.0 * column / resolution - 1.0;
                const bool rim = row % resolution == 0 || column % resolution == 0;
                const double y = rim ? 0.0 : side * height * hump(along) * hump(across);
                mesh.positions.emplace_back((along < 0.0 ? windward : lee) * along + horns * across * across, y,
                                            half_width * across);
            }
        }
        for (std::uint32_t row = 0; row < resolution; ++row) {
            for (std::uint32_t column = 0; column < resolution; ++column) {
                const std::uint32_t a = first + row * stride + column;
                const std::uint32_t b = a + 1;
                const std::uint32_t c = a + stride;
                const std::uint32_t d = c + 1;
                // Cut from the corners inward, or top and bottom would share a triangle there.
                const bool falling = (2 * row < resolution) == (2 * column < resolution);
                const std::array<glm::uvec3, 2> cut = falling ? std::array{glm::uvec3(a, c, d), glm::uvec3(a, d, b)}
                                                              : std::array{glm::uvec3(a, c, b), glm::uvec3(b, c, d)};
                for (const glm::uvec3& t : cut) {
                    mesh.triangles.push_back(side > 0.0 ? t : glm::uvec3(t.x, t.z, t.y));
                }
            }
        }
    }
    return weld(mesh);
}

constexpr std::array<std::string_view, 6> names = {"teapot", "rabbit", "sphere", "cube", "torus", "dune"};

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
    if (name == "dune") {
        return dune();
    }
    const std::string_view shown = name.substr(0, 80);
    const std::string_view nearest = *std::min_element(
        names.begin(), names.end(), [&](auto a, auto b) { return edit_distance(shown, a) < edit_distance(shown, b); });
    throw input_error("there is no built-in mesh \"{}\"; did you mean \"{}\"? There are {}", shown, nearest,
                      fmt::join(names, ", "));
}

} // namespace meltpoint
