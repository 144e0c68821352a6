// The Utah teapot: Martin Newell's control points (University of Utah, 1975), with the bottom that was added later.
// The data set's 32 patches are 10 up to symmetry. Lid, rim, body and bottom are (nearly) surfaces of revolution: four
// quarter turns of a control row (r, 0), (r, t), (t, r), (0, r) at some height. Handle and spout are mirrored.

#include "geometry/teapot.h"

#include <array>
#include <utility>

namespace meltpoint {

namespace {

/// A row of control points of a quarter turn about the vertical axis.
struct QuarterTurn {
    float radius;
    float tangent; ///< distance of the two inner control points from the far axis: 0.56 radius approximates a circle
    float height;
};

// From the knob down to the center of the bottom: patches share their first and last rows.
constexpr std::array<std::array<QuarterTurn, 4>, 6> turned = {{
    // knob
    {{{0.0f, 0.0f, 3.15f}, {0.8f, 0.45f, 3.15f}, {0.0f, 0.0f, 2.85f}, {0.2f, 0.112f, 2.7f}}},
    // lid
    {{{0.2f, 0.112f, 2.7f}, {0.4f, 0.224f, 2.55f}, {1.3f, 0.728f, 2.55f}, {1.3f, 0.728f, 2.4f}}},
    // rim
    {{{1.4f, 0.784f, 2.4f}, {1.3375f, 0.749f, 2.53125f}, {1.4375f, 0.805f, 2.53125f}, {1.5f, 0.84f, 2.4f}}},
    // body, above and below
    {{{1.5f, 0.84f, 2.4f}, {1.75f, 0.98f, 1.875f}, {2.0f, 1.12f, 1.35f}, {2.0f, 1.12f, 0.9f}}},
    {{{2.0f, 1.12f, 0.9f}, {2.0f, 1.12f, 0.45f}, {1.5f, 0.84f, 0.225f}, {1.5f, 0.84f, 0.15f}}},
    // bottom
    {{{1.5f, 0.84f, 0.15f}, {1.5f, 0.84f, 0.075f}, {1.425f, 0.798f, 0.0f}, {0.0f, 0.0f, 0.0f}}},
}};

/// A row of control points of half a tube: (a, 0), (a, -w), (b, -w), (b, 0), with (x, y) before and z after the comma.
struct HalfRing {
    glm::vec2 a;
    glm::vec2 b;
    float half_width;
};

constexpr std::array<std::array<HalfRing, 4>, 4> mirrored = {{
    // handle, its upper and lower half
    {{{{-1.6f, 2.025f}, {-1.5f, 2.25f}, 0.3f},
      {{-2.3f, 2.025f}, {-2.5f, 2.25f}, 0.3f},
      {{-2.7f, 2.025f}, {-3.0f, 2.25f}, 0.3f},
      {{-2.7f, 1.8f}, {-3.0f, 1.8f}, 0.3f}}},
    {{{{-2.7f, 1.8f}, {-3.0f, 1.8f}, 0.3f},
      {{-2.7f, 1.575f}, {-3.0f, 1.35f}, 0.3f},
      {{-2.5f, 1.125f}, {-2.65f, 0.9375f}, 0.3f},
      {{-2.0f, 0.9f}, {-1.9f, 0.6f}, 0.3f}}},
    // spout, from the body to the lip
    {{{{1.7f, 1.425f}, {1.7f, 0.6f}, 0.66f},
      {{2.6f, 1.425f}, {3.1f, 0.825f}, 0.66f},
      {{2.3f, 2.1f}, {2.4f, 2.025f}, 0.25f},
      {{2.7f, 2.4f}, {3.3f, 2.4f}, 0.25f}}},
    {{{{2.7f, 2.4f}, {3.3f, 2.4f}, 0.25f},
      {{2.8f, 2.475f}, {3.525f, 2.49375f}, 0.25f},
      {{2.9f, 2.475f}, {3.45f, 2.5125f}, 0.15f},
      {{2.8f, 2.4f}, {3.2f, 2.4f}, 0.15f}}},
}};

/// 4 x 4 control points; rows cross columns to the outside.
using Patch = std::array<std::array<glm::dvec3, 4>, 4>;

Patch turned_patch(const std::array<QuarterTurn, 4>& rows, int quarter)
{
    Patch patch;
    for (std::size_t row = 0; row < 4; ++row) {
        const auto [radius, tangent, height] = rows[row];
        patch[row] = {glm::dvec3{radius, height, 0.0f}, glm::dvec3{radius, height, -tangent},
                      glm::dvec3{tangent, height, -radius}, glm::dvec3{0.0f, height, -radius}};
        for (glm::dvec3& point : patch[row]) {
            for (int turn = 0; turn < quarter; ++turn) {
                point = {point.z, point.y, -point.x};
            }
        }
    }
    return patch;
}

Patch half_tube_patch(const std::array<HalfRing, 4>& rows, bool mirror)
{
    Patch patch;
    for (std::size_t row = 0; row < 4; ++row) {
        const auto& [a, b, w] = rows[row];
        patch[row] = {glm::dvec3{a.x, a.y, 0.0f}, glm::dvec3{a.x, a.y, -w}, glm::dvec3{b.x, b.y, -w},
                      glm::dvec3{b.x, b.y, 0.0f}};
        if (mirror) {
            std::swap(patch[row][0], patch[row][3]);
            std::swap(patch[row][1], patch[row][2]);
            for (glm::dvec3& point : patch[row]) {
                point.z = -point.z;
            }
        }
    }
    return patch;
}

std::array<double, 4> bernstein(double t)
{
    const double s = 1.0 - t;
    return {s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t};
}

glm::dvec3 evaluate(const Patch& patch, double u, double v)
{
    const std::array<double, 4> row_weights = bernstein(u);
    const std::array<double, 4> column_weights = bernstein(v);
    glm::dvec3 point(0.0);
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
            point += row_weights[row] * column_weights[column] * patch[row][column];
        }
    }
    return point;
}

void append(TriangleMesh& mesh, const Patch& patch, std::uint32_t resolution)
{
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const std::uint32_t stride = resolution + 1;
    for (std::uint32_t row = 0; row <= resolution; ++row) {
        for (std::uint32_t column = 0; column <= resolution; ++column) {
            mesh.positions.emplace_back(evaluate(patch, double(row) / resolution, double(column) / resolution));
        }
    }
    for (std::uint32_t row = 0; row < resolution; ++row) {
        for (std::uint32_t column = 0; column < resolution; ++column) {
            const std::uint32_t corner = first + row * stride + column;
            mesh.triangles.emplace_back(corner, corner + stride, corner + stride + 1);
            mesh.triangles.emplace_back(corner, corner + stride + 1, corner + 1);
        }
    }
}

/// Adds a part of the teapot, smooth in itself.
void append_smooth(TriangleMesh& mesh, const TriangleMesh& patches)
{
    TriangleMesh part = weld(patches);
    part.normals = smooth_normals(part);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
    for (const glm::uvec3& corners : part.triangles) {
        mesh.triangles.push_back(corners + first);
    }
}

} // namespace

TriangleMesh teapot(std::uint32_t resolution)
{
    TriangleMesh body_and_lid;
    for (const auto& rows : turned) {
        for (int quarter = 0; quarter < 4; ++quarter) {
            append(body_and_lid, turned_patch(rows, quarter), resolution);
        }
    }
    TriangleMesh handle_and_spout;
    for (const auto& rows : mirrored) {
        append(handle_and_spout, half_tube_patch(rows, false), resolution);
        append(handle_and_spout, half_tube_patch(rows, true), resolution);
    }
    TriangleMesh mesh;
    append_smooth(mesh, body_and_lid);
    append_smooth(mesh, handle_and_spout);
    return weld(mesh); // handle and body share one vertex, a crease
}

} // namespace meltpoint
