// Barill, Dickson, Schmidt, Levin & Jacobson 2018, "Fast winding numbers for soups and clouds", with the solid angle of
// van Oosterom & Strackee 1983, "The solid angle of a plane triangle", equation 8.

#include "geometry/winding_number.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace meltpoint {

namespace {

constexpr double coarse = 1.25; // accuracy where little depends on it
constexpr double coarse_error = 0.1;
constexpr std::uint32_t leaf_size = 4;
constexpr int stack_size = 64; // median splits: a tree over 2^32 triangles is 32 deep

/// Signed solid angle of a triangle seen from the point, positive from inside.
double solid_angle(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& point)
{
    const glm::dvec3 a = triangle[0] - point;
    const glm::dvec3 b = triangle[1] - point;
    const glm::dvec3 c = triangle[2] - point;
    const double length_a = glm::length(a);
    const double length_b = glm::length(b);
    const double length_c = glm::length(c);
    const double numerator = glm::dot(a, glm::cross(b, c));
    const double denominator = length_a * length_b * length_c + glm::dot(a, b) * length_c + glm::dot(b, c) * length_a +
                               glm::dot(c, a) * length_b;
    return 2.0 * std::atan2(numerator, denominator);
}

std::array<glm::dvec3, 3> corners_of(const TriangleMesh& mesh, const glm::uvec3& triangle)
{
    return {mesh.positions[triangle.x], mesh.positions[triangle.y], mesh.positions[triangle.z]};
}

std::vector<std::array<glm::dvec3, 3>> triangles_of(const TriangleMesh& mesh)
{
    std::vector<std::array<glm::dvec3, 3>> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const glm::uvec3& triangle : mesh.triangles) {
        triangles.push_back(corners_of(mesh, triangle));
    }
    return triangles;
}

glm::dvec3 centroid(const std::array<glm::dvec3, 3>& triangle)
{
    return (triangle[0] + triangle[1] + triangle[2]) / 3.0;
}

} // namespace

WindingNumber::WindingNumber(const TriangleMesh& mesh) : WindingNumber(triangles_of(mesh)) {}

WindingNumber::WindingNumber(std::vector<Triangle> triangles) : triangles_(std::move(triangles))
{
    if (!triangles_.empty()) {
        build(0, static_cast<std::uint32_t>(triangles_.size()));
    }
}

void WindingNumber::build(std::uint32_t first, std::uint32_t count)
{
    const std::size_t index = nodes_.size();
    Box box = box_of(triangles_[first]);
    for (std::uint32_t i = first + 1; i < first + count; ++i) {
        const Box other = box_of(triangles_[i]);
        box = {glm::min(box.min, other.min), glm::max(box.max, other.max)};
    }
    nodes_.push_back({box, multipole(first, count), first, count, 0});
    if (count <= leaf_size) {
        return;
    }
    const glm::dvec3 size = box.max - box.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t left_count = count / 2;
    const auto begin = triangles_.begin() + first;
    std::nth_element(begin, begin + left_count, begin + count,
                     [axis](const Triangle& a, const Triangle& b) { return centroid(a)[axis] < centroid(b)[axis]; });
    build(first, left_count);
    nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
    build(first + left_count, count - left_count);
}

WindingNumber::Multipole WindingNumber::multipole(std::uint32_t first, std::uint32_t count) const
{
    const auto area_vector = [](const Triangle& t) {
        return 0.5 * glm::cross(t[1] - t[0], t[2] - t[0]);
    };
    double area = 0.0;
    glm::dvec3 weighted(0.0);
    glm::dvec3 middle(0.0);
    for (std::uint32_t i = first; i < first + count; ++i) {
        const double weight = glm::length(area_vector(triangles_[i]));
        area += weight;
        weighted += weight * centroid(triangles_[i]);
        middle += centroid(triangles_[i]);
    }
    Multipole sum;
    sum.center = area > 0.0 ? weighted / area : middle / double(count);
    for (std::uint32_t i = first; i < first + count; ++i) {
        const Triangle& triangle = triangles_[i];
        const glm::dvec3 n = area_vector(triangle);
        const glm::dvec3 d = centroid(triangle) - sum.center;
        // Second moments of the triangle about the center, over its area: (9 d d^T + sum of corners c c^T) / 12.
        glm::dmat3 m = 9.0 * glm::outerProduct(d, d);
        for (const glm::dvec3& corner : triangle) {
            const glm::dvec3 c = corner - sum.center;
            m += glm::outerProduct(c, c);
            sum.radius = std::max(sum.radius, glm::length(c));
        }
        m /= 12.0;
        sum.dipole += n;

        // The forms (d . r) (n . r) and (r . m r) (n . r) without their traces, to which the field is blind.
        const double third = glm::dot(d, n) / 3.0;
        const std::array<double, 6> quadrupole = {d.x * n.x - third,     d.y * n.y - third,     d.z * n.z - third,
                                                  d.y * n.z + d.z * n.y, d.z * n.x + d.x * n.z, d.x * n.y + d.y * n.x};
        const glm::dvec3 t = (2.0 * (m * n) + (m[0][0] + m[1][1] + m[2][2]) * n) / 5.0;
        const std::array<double, 10> octupole = {m[0][0] * n.x - t.x,
                                                 m[1][1] * n.y - t.y,
                                                 m[2][2] * n.z - t.z,
                                                 m[0][0] * n.y + 2.0 * m[0][1] * n.x - t.y,
                                                 m[0][0] * n.z + 2.0 * m[0][2] * n.x - t.z,
                                                 m[1][1] * n.z + 2.0 * m[1][2] * n.y - t.z,
                                                 m[1][1] * n.x + 2.0 * m[0][1] * n.y - t.x,
                                                 m[2][2] * n.x + 2.0 * m[0][2] * n.z - t.x,
                                                 m[2][2] * n.y + 2.0 * m[1][2] * n.z - t.y,
                                                 2.0 * (m[0][1] * n.z + m[1][2] * n.x + m[0][2] * n.y)};
        for (std::size_t k = 0; k < quadrupole.size(); ++k) {
            sum.quadrupole[k] += quadrupole[k];
        }
        for (std::size_t k = 0; k < octupole.size(); ++k) {
            sum.octupole[k] += octupole[k];
        }
    }
    return sum;
}

/// Integral of n . f over the group with f = x / |x|^3, by the Taylor series of f around r (the center, seen from the
/// query): f is the negative gradient of 1/|x|, so its derivatives are symmetric and free of traces.
double WindingNumber::Multipole::solid_angle(const glm::dvec3& r, double r2) const
{
    const glm::dvec3 s = r * r;
    const std::array<double, 6>& q = quadrupole;
    const std::array<double, 10>& o = octupole;
    const double quadratic =
        q[0] * s.x + q[1] * s.y + q[2] * s.z + q[3] * r.y * r.z + q[4] * r.z * r.x + q[5] * r.x * r.y;
    const double cubic = r.x * (o[0] * s.x + o[6] * s.y + o[7] * s.z) + r.y * (o[3] * s.x + o[1] * s.y + o[8] * s.z) +
                         r.z * (o[4] * s.x + o[5] * s.y + o[2] * s.z) + o[9] * r.x * r.y * r.z;
    const double inverse_r2 = 1.0 / r2;
    const double inverse_r3 = inverse_r2 / std::sqrt(r2);
    return inverse_r3 * (glm::dot(dipole, r) + inverse_r2 * (-3.0 * quadratic + 7.5 * inverse_r2 * cubic));
}

WindingNumber::Box WindingNumber::box_of(const Triangle& triangle)
{
    return {glm::min(triangle[0], glm::min(triangle[1], triangle[2])),
            glm::max(triangle[0], glm::max(triangle[1], triangle[2]))};
}

double WindingNumber::at(const glm::dvec3& point, double accuracy) const
{
    double sum = 0.0;
    std::array<std::uint32_t, stack_size> stack{};
    int waiting = nodes_.empty() ? 0 : 1;
    while (waiting > 0) {
        const std::uint32_t index = stack[--waiting];
        const Node& node = nodes_[index];
        const glm::dvec3 r = node.far_field.center - point;
        const double r2 = glm::dot(r, r);
        const double reach = accuracy * node.far_field.radius;
        if (r2 > reach * reach) {
            sum += node.far_field.solid_angle(r, r2);
        } else if (node.right == 0) {
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                sum += solid_angle(triangles_[i], point);
            }
        } else {
            stack[waiting++] = node.right;
            stack[waiting++] = index + 1;
        }
    }
    return sum / (4.0 * std::numbers::pi);
}

bool WindingNumber::is_inside(const glm::dvec3& point) const
{
    const double w = at(point, coarse);
    return std::abs(w - 0.5) > coarse_error ? w >= 0.5 : at(point) >= 0.5;
}

bool WindingNumber::may_touch_box(const glm::dvec3& low, const glm::dvec3& high) const
{
    const auto near = [&](const Box& box) {
        return glm::all(glm::lessThanEqual(box.min, high)) && glm::all(glm::lessThanEqual(low, box.max));
    };
    std::array<std::uint32_t, stack_size> stack{};
    int waiting = nodes_.empty() ? 0 : 1;
    while (waiting > 0) {
        const std::uint32_t index = stack[--waiting];
        const Node& node = nodes_[index];
        if (!near(node.box)) {
            continue;
        }
        if (node.right != 0) {
            stack[waiting++] = node.right;
            stack[waiting++] = index + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            if (near(box_of(triangles_[i]))) {
                return true;
            }
        }
    }
    return false;
}

double winding_number_exact(const TriangleMesh& mesh, const glm::dvec3& point)
{
    double sum = 0.0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        sum += solid_angle(corners_of(mesh, triangle), point);
    }
    return sum / (4.0 * std::numbers::pi);
}

} // namespace meltpoint
