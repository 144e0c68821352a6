#include "geometry/normal_orientation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

namespace meltpoint {

namespace {

constexpr std::size_t most_edges = 20; // of a point to its neighbors
constexpr double flat = 1e-6;          // of the volume that a piece encloses, over area * extent

/// Neighbors in either direction.
class Graph {
public:
    Graph(std::size_t points, const LocalPlanes& planes) : begin_(points + 1, 0)
    {
        visit_edges(points, planes, [&](std::uint32_t i, std::uint32_t j) {
            ++begin_[i];
            ++begin_[j];
        });
        std::uint64_t sum = 0;
        for (std::uint64_t& begin : begin_) {
            sum += begin;
            begin = sum; // of what follows: filled from the end
        }
        ends_.resize(sum);
        visit_edges(points, planes, [&](std::uint32_t i, std::uint32_t j) {
            ends_[--begin_[i]] = j;
            ends_[--begin_[j]] = i;
        });
    }

    [[nodiscard]] std::span<const std::uint32_t> near(std::uint32_t i) const
    {
        return std::span(ends_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
    }

private:
    /// At most `most_edges` of each point, spread over its neighbors from near to far.
    template <class Visit>
    static void visit_edges(std::size_t points, const LocalPlanes& planes, const Visit& visit)
    {
        for (std::uint32_t i = 0; i < points; ++i) {
            const std::span<const std::uint32_t> neighbors = planes.neighbors(i);
            const std::size_t step = (neighbors.size() + most_edges - 1) / most_edges;
            for (std::size_t k = 0; k < neighbors.size(); k += step) {
                visit(i, neighbors[k]);
            }
        }
    }

    std::vector<std::uint64_t> begin_;
    std::vector<std::uint32_t> ends_;
};

/// Grows the minimum spanning tree by Prim's algorithm.
class SpanningTree {
public:
    SpanningTree(const LocalPlanes& planes, std::vector<glm::vec3>& normals)
        : normals_(&normals), graph_(normals.size(), planes),
          lowest_cost_(normals.size(), std::numeric_limits<float>::infinity()), reached_(normals.size(), 0)
    {
    }

    [[nodiscard]] bool has_reached(std::uint32_t i) const { return reached_[i] != 0; }

    void add_root(std::uint32_t root) { reach(root); }

    /// Reaches all that the roots connect to. Returns them without the roots.
    std::vector<std::uint32_t> grow()
    {
        std::vector<std::uint32_t> grown;
        while (!queue_.empty()) {
            const auto [cost, point, from] = queue_.top();
            queue_.pop();
            if (has_reached(point)) {
                continue;
            }
            glm::vec3& normal = (*normals_)[point];
            if (glm::dot((*normals_)[from], normal) < 0.0f) {
                normal = -normal;
            }
            reach(point);
            grown.push_back(point);
        }
        return grown;
    }

private:
    using Step = std::tuple<float, std::uint32_t, std::uint32_t>; ///< cost, to, from: all of them, to decide ties

    void reach(std::uint32_t point)
    {
        reached_[point] = 1;
        for (const std::uint32_t other : graph_.near(point)) {
            const glm::vec3& normal = (*normals_)[other];
            if (has_reached(other) || normal == glm::vec3(0.0f)) {
                continue;
            }
            const float cost = 1.0f - std::min(std::abs(glm::dot((*normals_)[point], normal)), 1.0f);
            if (cost <= lowest_cost_[other]) {
                lowest_cost_[other] = cost;
                queue_.emplace(cost, other, point);
            }
        }
    }

    std::vector<glm::vec3>* normals_;
    Graph graph_;
    std::vector<float> lowest_cost_;
    std::vector<std::uint8_t> reached_;
    std::priority_queue<Step, std::vector<Step>, std::greater<>> queue_;
};

/// Whether a piece of a surface faces inward.
bool faces_inward(std::span<const std::uint32_t> piece, std::span<const glm::vec3> points, const LocalPlanes& planes,
                  const std::vector<glm::vec3>& normals)
{
    double area = 0.0;
    glm::dvec3 middle(0.0);
    glm::dvec3 mean_normal(0.0);
    const glm::dvec3 origin(points[piece.front()]);
    std::vector<double> areas;
    areas.reserve(piece.size());
    for (const std::uint32_t i : piece) {
        areas.push_back(std::pow(planes.spacing(i), 2));
        area += areas.back();
        middle += areas.back() * (glm::dvec3(points[i]) - origin);
        mean_normal += areas.back() * glm::dvec3(normals[i]);
    }
    middle /= std::max(area, std::numeric_limits<double>::min());
    double flux = 0.0; // three times the volume
    double extent = 0.0;
    for (std::size_t k = 0; k < piece.size(); ++k) {
        const glm::dvec3 x = glm::dvec3(points[piece[k]]) - origin - middle;
        flux += areas[k] * glm::dot(x, glm::dvec3(normals[piece[k]]));
        extent = std::max(extent, glm::length(x));
    }
    if (std::abs(flux) > flat * area * extent) {
        return flux < 0.0;
    }
    for (const double along : {mean_normal.y, mean_normal.z, mean_normal.x}) {
        if (std::abs(along) > 0.1 * area) {
            return along < 0.0;
        }
    }
    return false;
}

} // namespace

std::size_t orient_normals(std::span<const glm::vec3> points, const LocalPlanes& planes,
                           std::span<const std::uint8_t> given, std::vector<glm::vec3>& normals)
{
    SpanningTree tree(planes, normals);
    const auto count = static_cast<std::uint32_t>(points.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        if (given[i] != 0) {
            tree.add_root(i);
        }
    }
    tree.grow();
    std::size_t pieces = 0;
    for (std::uint32_t root = 0; root < count; ++root) {
        if (tree.has_reached(root) || normals[root] == glm::vec3(0.0f)) {
            continue;
        }
        tree.add_root(root);
        std::vector<std::uint32_t> piece = tree.grow();
        piece.push_back(root);
        ++pieces;
        if (faces_inward(piece, points, planes, normals)) {
            for (const std::uint32_t i : piece) {
                normals[i] = -normals[i];
            }
        }
    }
    return pieces;
}

} // namespace meltpoint
