#include "geometry/mesh_solid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/parallel_for.h"
#include "geometry/measure_volume.h"
#include "geometry/row_crossings.h"
#include "geometry/winding_thresholds.h"

namespace meltpoint {

namespace {

constexpr double coarse = 1.25; // accuracy of winding numbers where little depends on it
constexpr double coarse_error = 0.1;

/// An edge that more triangles use from `from` to `to` than back.
struct BoundaryEdge {
    std::uint32_t from;
    std::uint32_t to;
    int excess;
};

std::vector<BoundaryEdge> boundary_edges(const TriangleMesh& mesh)
{
    std::vector<BoundaryEdge> edges; // of all triangles, from the lower vertex to the higher
    edges.reserve(3 * mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t a = t[corner];
            const std::uint32_t b = t[(corner + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
        }
    }
    const auto same = [](const BoundaryEdge& a, const BoundaryEdge& b) {
        return a.from == b.from && a.to == b.to;
    };
    std::sort(edges.begin(), edges.end(), [](const BoundaryEdge& a, const BoundaryEdge& b) {
        return a.from != b.from ? a.from < b.from : a.to < b.to;
    });
    std::vector<BoundaryEdge> boundary;
    for (auto run = edges.begin(); run != edges.end();) {
        BoundaryEdge sum{run->from, run->to, 0};
        for (; run != edges.end() && same(*run, sum); ++run) {
            sum.excess += run->excess;
        }
        if (sum.excess > 0) {
            boundary.push_back(sum);
        } else if (sum.excess < 0) {
            boundary.push_back({sum.to, sum.from, -sum.excess});
        }
    }
    return boundary;
}

/// A vertex that stands for all that the edges connect, for each vertex (union-find with path halving).
class Components {
public:
    explicit Components(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

    std::uint32_t find(std::uint32_t i)
    {
        while (parent_[i] != i) {
            i = parent_[i] = parent_[parent_[i]];
        }
        return i;
    }

    void join(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

private:
    std::vector<std::uint32_t> parent_;
};

TriangleMesh together(const TriangleMesh& mesh, const TriangleMesh& cones)
{
    TriangleMesh closed;
    closed.positions = mesh.positions;
    closed.triangles = mesh.triangles;
    const auto first = static_cast<std::uint32_t>(closed.positions.size());
    closed.positions.insert(closed.positions.end(), cones.positions.begin(), cones.positions.end());
    for (const glm::uvec3& corners : cones.triangles) {
        closed.triangles.push_back(corners + first);
    }
    return closed;
}

} // namespace

TriangleMesh boundary_cones(const TriangleMesh& mesh)
{
    struct Hole {
        glm::dvec3 sum{0.0};
        double count = 0.0;
        std::uint32_t apex = 0;
    };
    const std::vector<BoundaryEdge> edges = boundary_edges(mesh);
    Components components(mesh.positions.size());
    for (const BoundaryEdge& edge : edges) {
        components.join(edge.from, edge.to);
    }
    std::map<std::uint32_t, Hole> holes;
    for (const BoundaryEdge& edge : edges) {
        Hole& hole = holes[components.find(edge.from)];
        hole.sum += glm::dvec3(mesh.positions[edge.from]) + glm::dvec3(mesh.positions[edge.to]);
        hole.count += 2.0;
    }
    TriangleMesh cones;
    for (auto& [component, hole] : holes) {
        hole.apex = static_cast<std::uint32_t>(cones.positions.size());
        cones.positions.emplace_back(hole.sum / hole.count);
    }
    for (const BoundaryEdge& edge : edges) {
        const auto first = static_cast<std::uint32_t>(cones.positions.size());
        cones.positions.push_back(mesh.positions[edge.from]);
        cones.positions.push_back(mesh.positions[edge.to]);
        const std::uint32_t apex = holes[components.find(edge.from)].apex;
        cones.triangles.insert(cones.triangles.end(), static_cast<std::size_t>(edge.excess),
                               glm::uvec3(first + 1, first, apex));
    }
    return cones;
}

MeshSolid::MeshSolid(const TriangleMesh& mesh) : MeshSolid(mesh, boundary_cones(mesh)) {}

MeshSolid::MeshSolid(const TriangleMesh& mesh, const TriangleMesh& cones)
    : bounds_(meltpoint::bounds(mesh)), closed_(together(mesh, cones)), mesh_(mesh), cones_(cones)
{
}

double MeshSolid::volume() const
{
    tbb::collaborative_call_once(measured_, [this] { volume_ = measure_volume(*this); });
    return volume_;
}

bool MeshSolid::contains(const glm::dvec3& point) const
{
    return mesh_.is_inside(point);
}

bool MeshSolid::contains(const glm::dvec3& point, int closed) const
{
    const double w = closed - cones_.at(point, coarse);
    return std::abs(w - 0.5) > coarse_error ? w >= 0.5 : closed - cones_.at(point) >= 0.5;
}

CellMask MeshSolid::mask(const CellGrid& grid) const
{
    CellMask mask(grid.size(), 0);
    const std::vector<std::int8_t> thresholds = winding_thresholds(cones_, grid);
    for (std::size_t number = 0; number < grid.points.size(); ++number) {
        const RowCrossings crossings(closed_, grid, number);
        parallel_for(grid.rows(), [&](std::size_t row) {
            const bool certain = crossings.is_certain(row);
            const std::span<const RowCrossings::Crossing> of_row = crossings.of_row(row);
            auto next = of_row.begin();
            int closed = 0;
            for (glm::uvec3 cell = grid.row_begin(row); cell.x < grid.count.x; ++cell.x) {
                for (const double x = grid.along_row(cell, number); next != of_row.end() && next->x <= x; ++next) {
                    closed += next->change;
                }
                const std::int8_t threshold = thresholds[grid.index(cell)];
                const bool inside = !certain                    ? contains(grid.point(cell, number))
                                    : threshold != no_threshold ? closed >= threshold
                                                                : contains(grid.point(cell, number), closed);
                mask[grid.index(cell)] |= static_cast<std::uint8_t>(unsigned{inside} << number);
            }
        });
    }
    return mask;
}

} // namespace meltpoint
