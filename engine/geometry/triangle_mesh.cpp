#include "geometry/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "core/error.h"

namespace meltpoint {

namespace {

constexpr double smallest_extent = 1e-9; // m
constexpr double largest_extent = 1e9;   // m
constexpr double weld_tolerance = 1e-6;  // of the extent
constexpr double crease_cosine = 0.8660254037844387;
constexpr std::uint32_t no_vertex = std::numeric_limits<std::uint32_t>::max();

bool is_finite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

double largest(const glm::vec3& v)
{
    return std::max({double(v.x), double(v.y), double(v.z)});
}

glm::vec3 unit_or_zero(const glm::dvec3& v)
{
    const double length = glm::length(v);
    return length > 0.0 ? glm::vec3(v / length) : glm::vec3(0.0f);
}

/// Points in cells four tolerances wide, hashed: whatever lies within the tolerance of a point is mostly in its own
/// cell, and points further apart than that cannot crowd one.
class PointGrid {
public:
    PointGrid(const glm::vec3& origin, double tolerance) : origin_(origin), tolerance_(tolerance) {}

    /// Index of the first point added within the tolerance, or no_vertex.
    [[nodiscard]] std::uint32_t find(const glm::vec3& point, const std::vector<glm::vec3>& points) const
    {
        const glm::i64vec3 first = cell(glm::dvec3(point) - tolerance_);
        const glm::i64vec3 last = cell(glm::dvec3(point) + tolerance_);
        std::uint32_t found = no_vertex;
        for (std::int64_t z = first.z; z <= last.z; ++z) {
            for (std::int64_t y = first.y; y <= last.y; ++y) {
                for (std::int64_t x = first.x; x <= last.x; ++x) {
                    const auto [begin, end] = cells_.equal_range(key({x, y, z}));
                    for (auto entry = begin; entry != end; ++entry) {
                        const glm::dvec3 gap = glm::dvec3(points[entry->second]) - glm::dvec3(point);
                        if (glm::dot(gap, gap) <= tolerance_ * tolerance_) {
                            found = std::min(found, entry->second);
                        }
                    }
                }
            }
        }
        return found;
    }

    void add(const glm::vec3& point, std::uint32_t index) { cells_.emplace(key(cell(glm::dvec3(point))), index); }

private:
    [[nodiscard]] glm::i64vec3 cell(const glm::dvec3& point) const
    {
        return {glm::floor((point - origin_) / (4.0 * tolerance_))};
    }

    /// The extent spans a quarter of a million cells, so 21 bits an axis tell all of them apart.
    static std::uint64_t key(const glm::i64vec3& cell)
    {
        const auto bits = [](std::int64_t i) {
            return static_cast<std::uint64_t>(i + 1) & 0x1fffff;
        };
        return bits(cell.x) | bits(cell.y) << 21 | bits(cell.z) << 42;
    }

    glm::dvec3 origin_;
    double tolerance_;
    std::unordered_multimap<std::uint64_t, std::uint32_t> cells_;
};

/// For every vertex, the first one that it coincides with (itself where there is none).
std::vector<std::uint32_t> coincident_vertices(const TriangleMesh& mesh)
{
    const Aabb box = bounds(mesh);
    const double tolerance = std::max(weld_tolerance * largest(box.size()), std::numeric_limits<double>::min());
    PointGrid grid(box.min, tolerance);
    std::vector<std::uint32_t> first_of(mesh.positions.size());
    for (std::uint32_t i = 0; i < first_of.size(); ++i) {
        const std::uint32_t found = grid.find(mesh.positions[i], mesh.positions);
        first_of[i] = found == no_vertex ? i : found;
        if (found == no_vertex) {
            grid.add(mesh.positions[i], i);
        }
    }
    return first_of;
}

/// Means of the normals of coincident vertices, stored at the first of them; zero at creases.
std::vector<glm::vec3> merged_normals(const TriangleMesh& mesh, const std::vector<std::uint32_t>& first_of)
{
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i < first_of.size(); ++i) {
        sums[first_of[i]] += glm::dvec3(unit_or_zero(mesh.normals[i]));
    }
    std::vector<glm::vec3> merged(sums.size());
    std::transform(sums.begin(), sums.end(), merged.begin(), unit_or_zero);
    std::vector<bool> crease(sums.size(), false);
    for (std::size_t i = 0; i < first_of.size(); ++i) {
        const glm::vec3 mean = merged[first_of[i]];
        crease[first_of[i]] = crease[first_of[i]] || !(glm::dot(mean, unit_or_zero(mesh.normals[i])) >= crease_cosine);
    }
    for (std::size_t i = 0; i < merged.size(); ++i) {
        if (crease[i]) {
            merged[i] = glm::vec3(0.0f);
        }
    }
    return merged;
}

} // namespace

void validate(const TriangleMesh& mesh, std::string_view name)
{
    if (mesh.triangles.empty()) {
        throw input_error("{}: the mesh has no triangles", name);
    }
    if (mesh.positions.size() >= no_vertex || mesh.triangles.size() >= no_vertex) {
        throw input_error("{}: the mesh has {} vertices and {} triangles, at most {} are supported", name,
                          mesh.positions.size(), mesh.triangles.size(), no_vertex - 1);
    }
    if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) {
        throw input_error("{}: the mesh has {} normals for {} vertices", name, mesh.normals.size(),
                          mesh.positions.size());
    }
    if (!mesh.colors.empty() && mesh.colors.size() != mesh.positions.size()) {
        throw input_error("{}: the mesh has {} colors for {} vertices", name, mesh.colors.size(),
                          mesh.positions.size());
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3& corners = mesh.triangles[i];
        const std::uint32_t highest = std::max({corners.x, corners.y, corners.z});
        if (highest >= mesh.positions.size()) {
            throw input_error("{}: triangle {} names vertex {}, but the mesh has only {} vertices", name, i, highest,
                              mesh.positions.size());
        }
    }
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (!is_finite(mesh.positions[i])) {
            throw input_error("{}: vertex {} is not finite ({}, {}, {})", name, i, mesh.positions[i].x,
                              mesh.positions[i].y, mesh.positions[i].z);
        }
    }
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        if (!is_finite(mesh.normals[i])) {
            throw input_error("{}: the normal of vertex {} is not finite", name, i);
        }
    }
    const Aabb box = bounds(mesh);
    const double extent = largest(glm::max(box.size(), glm::max(glm::abs(box.min), glm::abs(box.max))));
    if (extent > largest_extent) {
        throw input_error("{}: the mesh reaches {:g} m, at most {:g} m are supported", name, extent, largest_extent);
    }
    if (largest(box.size()) < smallest_extent) {
        throw input_error("{}: the mesh is {:g} m across, at least {:g} m are needed", name, largest(box.size()),
                          smallest_extent);
    }
    if (!(surface_area(mesh) > 0.0)) {
        throw input_error("{}: all triangles of the mesh have zero area", name);
    }
}

Aabb bounds(const TriangleMesh& mesh)
{
    Aabb box;
    for (const glm::vec3& position : mesh.positions) {
        box.extend(position);
    }
    return box;
}

glm::dvec3 area_vector(const TriangleMesh& mesh, std::size_t triangle)
{
    const glm::uvec3& corners = mesh.triangles[triangle];
    const glm::dvec3 a(mesh.positions[corners.x]);
    const glm::dvec3 b(mesh.positions[corners.y]);
    const glm::dvec3 c(mesh.positions[corners.z]);
    return 0.5 * glm::cross(b - a, c - a);
}

double triangle_area(const TriangleMesh& mesh, std::size_t triangle)
{
    return glm::length(area_vector(mesh, triangle));
}

double surface_area(const TriangleMesh& mesh)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        sum += triangle_area(mesh, i);
    }
    return sum;
}

double signed_volume(const TriangleMesh& mesh)
{
    // Tetrahedra are built on the box's center, so that a mesh far from the origin keeps its digits.
    const glm::dvec3 center(bounds(mesh).center());
    double sum = 0.0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::dvec3 corner(mesh.positions[mesh.triangles[i].x]);
        sum += glm::dot(corner - center, area_vector(mesh, i)) / 3.0;
    }
    return sum;
}

TriangleMesh weld(const TriangleMesh& mesh)
{
    const std::vector<std::uint32_t> first_of = coincident_vertices(mesh);
    const std::vector<glm::vec3> normals =
        mesh.normals.empty() ? std::vector<glm::vec3>{} : merged_normals(mesh, first_of);

    TriangleMesh welded;
    std::vector<bool> used(mesh.positions.size(), false);
    for (const glm::uvec3& corners : mesh.triangles) {
        const glm::uvec3 merged(first_of[corners.x], first_of[corners.y], first_of[corners.z]);
        if (merged.x != merged.y && merged.y != merged.z && merged.z != merged.x) {
            welded.triangles.push_back(merged);
            used[merged.x] = used[merged.y] = used[merged.z] = true;
        }
    }
    std::vector<std::uint32_t> new_index(mesh.positions.size(), no_vertex);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (used[i]) {
            new_index[i] = static_cast<std::uint32_t>(welded.positions.size());
            welded.positions.push_back(mesh.positions[i]);
            if (!normals.empty()) {
                welded.normals.push_back(normals[i]);
            }
            if (!mesh.colors.empty()) {
                welded.colors.push_back(mesh.colors[i]);
            }
        }
    }
    for (glm::uvec3& corners : welded.triangles) {
        corners = {new_index[corners.x], new_index[corners.y], new_index[corners.z]};
    }
    return welded;
}

std::vector<glm::vec3> smooth_normals(const TriangleMesh& mesh)
{
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::dvec3 area = area_vector(mesh, i);
        for (int corner = 0; corner < 3; ++corner) {
            sums[mesh.triangles[i][corner]] += area;
        }
    }
    std::vector<glm::vec3> normals(sums.size());
    std::transform(sums.begin(), sums.end(), normals.begin(), unit_or_zero);
    return normals;
}

void transform(TriangleMesh& mesh, const glm::mat4& matrix)
{
    const glm::dmat4 precise(matrix);
    const glm::dmat3 linear(precise);
    // The cofactor matrix is det * inverse transpose: the same direction for normals, and no division by a determinant.
    const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                              glm::cross(linear[0], linear[1]));
    const bool reflects = glm::determinant(linear) < 0.0;
    for (glm::vec3& position : mesh.positions) {
        position = glm::vec3(precise * glm::dvec4(position, 1.0));
    }
    for (glm::vec3& normal : mesh.normals) {
        normal = unit_or_zero((reflects ? -1.0 : 1.0) * (cofactor * glm::dvec3(normal)));
    }
    if (reflects) {
        for (glm::uvec3& corners : mesh.triangles) {
            std::swap(corners.y, corners.z);
        }
    }
}

} // namespace meltpoint
