#include "geometry/implicit_surface.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace meltpoint {

namespace {

constexpr std::uint32_t no_vertex = std::numeric_limits<std::uint32_t>::max();

/// Samples of the function on the corners of cubic cells.
class Samples {
public:
    Samples(const ImplicitFunction& function, const Aabb& box, double cell)
        : origin_(box.min), cell_(cell), size_(glm::ceil(glm::dvec3(box.size()) / cell) + 1.0)
    {
        value_.reserve(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                       static_cast<std::size_t>(size_.z));
        for (int z = 0; z < size_.z; ++z) {
            for (int y = 0; y < size_.y; ++y) {
                for (int x = 0; x < size_.x; ++x) {
                    value_.push_back(function(position({x, y, z})));
                }
            }
        }
    }

    [[nodiscard]] const glm::ivec3& size() const { return size_; }
    [[nodiscard]] glm::dvec3 position(const glm::dvec3& corner) const { return origin_ + cell_ * corner; }
    [[nodiscard]] std::size_t index(const glm::ivec3& corner) const
    {
        const auto row =
            static_cast<std::size_t>(corner.z) * static_cast<std::size_t>(size_.y) + static_cast<std::size_t>(corner.y);
        return row * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(corner.x);
    }
    [[nodiscard]] double at(const glm::ivec3& corner) const { return value_[index(corner)]; }
    [[nodiscard]] bool inside(const glm::ivec3& corner) const { return at(corner) < 0.0; }

private:
    glm::dvec3 origin_;
    double cell_;
    glm::ivec3 size_;
    std::vector<double> value_;
};

constexpr glm::ivec3 unit(int axis)
{
    return {axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0};
}

template <class Visit>
void for_each_corner(const glm::ivec3& first, const glm::ivec3& end, const Visit& visit)
{
    for (int z = first.z; z < end.z; ++z) {
        for (int y = first.y; y < end.y; ++y) {
            for (int x = first.x; x < end.x; ++x) {
                visit(glm::ivec3(x, y, z));
            }
        }
    }
}

/// Mean of the points where the surface crosses the edges of a cell, in corners; false where it crosses none.
bool cell_vertex(const Samples& samples, const glm::ivec3& cell, glm::dvec3& vertex)
{
    glm::dvec3 sum(0.0);
    int crossings = 0;
    for (int axis = 0; axis < 3; ++axis) {
        for (int edge = 0; edge < 4; ++edge) {
            const glm::ivec3 from = cell + (edge & 1) * unit((axis + 1) % 3) + (edge >> 1 & 1) * unit((axis + 2) % 3);
            const double start = samples.at(from);
            const double stop = samples.at(from + unit(axis));
            if ((start < 0.0) != (stop < 0.0)) {
                sum += glm::dvec3(from) + start / (start - stop) * glm::dvec3(unit(axis));
                ++crossings;
            }
        }
    }
    vertex = crossings > 0 ? sum / static_cast<double>(crossings) : sum;
    return crossings > 0;
}

glm::dvec3 gradient(const ImplicitFunction& function, const glm::dvec3& x, double reach)
{
    glm::dvec3 result(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 offset = reach * glm::dvec3(unit(axis));
        result[axis] = (function(x + offset) - function(x - offset)) / (2.0 * reach);
    }
    return result;
}

} // namespace

TriangleMesh polygonize(const ImplicitFunction& function, const Aabb& box, double cell)
{
    const Samples samples(function, box, cell);
    TriangleMesh mesh;
    std::vector<std::uint32_t> vertex_of_cell(samples.index(samples.size() - 1) + 1, no_vertex);
    for_each_corner(glm::ivec3(0), samples.size() - 1, [&](const glm::ivec3& at) {
        glm::dvec3 vertex;
        if (!cell_vertex(samples, at, vertex)) {
            return;
        }
        glm::dvec3 x = samples.position(vertex);
        const double reach = 1e-3 * cell;
        for (int newton = 0; newton < 3; ++newton) {
            const glm::dvec3 slope = gradient(function, x, reach);
            const glm::dvec3 step = function(x) / std::max(glm::dot(slope, slope), 0.25) * slope;
            x -= step * std::min(1.0, 0.5 * cell / std::max(glm::length(step), reach)); // stays near its cell
        }
        vertex_of_cell[samples.index(at)] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.emplace_back(x);
        mesh.normals.emplace_back(glm::normalize(gradient(function, x, reach)));
    });

    for (int axis = 0; axis < 3; ++axis) {
        const glm::ivec3 left = unit((axis + 1) % 3);
        const glm::ivec3 below = unit((axis + 2) % 3);
        for_each_corner(left + below, samples.size() - unit(axis) - left - below, [&](const glm::ivec3& from) {
            if (samples.inside(from) == samples.inside(from + unit(axis))) {
                return;
            }
            std::array<std::uint32_t, 4> quad = {
                vertex_of_cell[samples.index(from - left - below)], vertex_of_cell[samples.index(from - below)],
                vertex_of_cell[samples.index(from)], vertex_of_cell[samples.index(from - left)]};
            if (!samples.inside(from)) { // the surface looks against the axis
                std::swap(quad[1], quad[3]);
            }
            mesh.triangles.emplace_back(quad[0], quad[1], quad[2]);
            mesh.triangles.emplace_back(quad[0], quad[2], quad[3]);
        });
    }
    return mesh;
}

} // namespace meltpoint
