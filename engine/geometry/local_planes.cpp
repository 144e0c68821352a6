#include "geometry/local_planes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "geometry/nearest_points.h"
#include "geometry/tangent_frame.h"

namespace meltpoint {

namespace {

constexpr std::size_t fewest_neighbors = 20;
constexpr std::size_t most_neighbors = 80;
constexpr double one_sided = 0.75 * std::numbers::pi; // the widest angle without a neighbor
// Of the second largest variance over the largest: below the one more neighbors are asked for, below the other points
// lie on a line. In terms of lengths they are 1/7 and 1/100.
constexpr double narrow = 0.02;
constexpr double line = 1e-4;

struct Fit {
    glm::vec3 normal{0.0f};
    double flatness = 0.0; ///< second largest variance over the largest
};

Fit fit_plane(std::span<const glm::vec3> points, std::uint32_t point, std::span<const std::uint32_t> neighbors)
{
    if (neighbors.empty()) {
        return {};
    }
    const glm::dvec3 origin(points[point]);
    glm::dvec3 sum(0.0); // the point itself is the origin
    for (const std::uint32_t j : neighbors) {
        sum += glm::dvec3(points[j]) - origin;
    }
    const glm::dvec3 mean = sum / static_cast<double>(neighbors.size() + 1);
    glm::dmat3 moments = glm::outerProduct(mean, mean);
    for (const std::uint32_t j : neighbors) {
        const glm::dvec3 d = glm::dvec3(points[j]) - origin - mean;
        moments += glm::outerProduct(d, d);
    }
    Eigen::Matrix3d covariance;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            covariance(row, column) = moments[column][row];
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance); // eigenvalues ascend
    const Eigen::Vector3d normal = solver.eigenvectors().col(0);
    const double largest = solver.eigenvalues()[2];
    const double flatness = largest > 0.0 ? solver.eigenvalues()[1] / largest : 0.0;
    return {flatness > line ? glm::vec3(normal.x(), normal.y(), normal.z()) : glm::vec3(0.0f), flatness};
}

/// The widest angle between the directions of neighbors in the plane.
double widest_gap(std::span<const glm::vec3> points, std::uint32_t point, std::span<const std::uint32_t> neighbors,
                  const glm::vec3& normal)
{
    const TangentFrame frame(glm::normalize(glm::dvec3(normal)));
    std::vector<double> directions;
    for (const std::uint32_t j : neighbors) {
        const glm::dvec3 way = glm::dvec3(points[j]) - glm::dvec3(points[point]);
        directions.push_back(std::atan2(glm::dot(way, frame.v), glm::dot(way, frame.u)));
    }
    std::sort(directions.begin(), directions.end());
    double widest = directions.front() + 2.0 * std::numbers::pi - directions.back();
    for (std::size_t i = 1; i < directions.size(); ++i) {
        widest = std::max(widest, directions[i] - directions[i - 1]);
    }
    return widest;
}

struct Neighborhood {
    std::vector<std::uint32_t> neighbors;
    glm::vec3 normal{0.0f};
};

Neighborhood neighborhood_of(std::span<const glm::vec3> points, std::uint32_t point, const NearestPoints& nearest)
{
    Neighborhood first; // that is no line
    Neighborhood last;
    for (std::size_t count = fewest_neighbors; count <= most_neighbors; count *= 2) {
        last.neighbors = nearest.of(point, count);
        const Fit fit = fit_plane(points, point, last.neighbors);
        last.normal = fit.normal;
        if (fit.flatness >= narrow) {
            if (widest_gap(points, point, last.neighbors, fit.normal) <= one_sided) {
                return last;
            }
            first = first.neighbors.empty() ? last : first;
        }
        if (last.neighbors.size() < count) {
            break; // there are no more
        }
    }
    return first.neighbors.empty() ? last : first;
}

} // namespace

LocalPlanes::LocalPlanes(std::span<const glm::vec3> points) : normals_(points.size()), own_spacings_(points.size())
{
    const NearestPoints nearest(points);
    neighbors_ = Lists<std::uint32_t>(points.size(), [&](std::size_t i, std::vector<std::uint32_t>& lists) {
        const auto [neighbors, normal] = neighborhood_of(points, static_cast<std::uint32_t>(i), nearest);
        normals_[i] = normal;
        if (!neighbors.empty()) {
            const double reach = glm::distance(glm::dvec3(points[i]), glm::dvec3(points[neighbors.back()]));
            const double area = std::numbers::pi * reach * reach / static_cast<double>(neighbors.size());
            own_spacings_[i] = static_cast<float>(std::sqrt(area));
        }
        lists.insert(lists.end(), neighbors.begin(), neighbors.end());
    });
}

double LocalPlanes::spacing(std::size_t point) const
{
    std::vector<float> spacings{own_spacings_[point]};
    for (const std::uint32_t j : neighbors_[point]) {
        spacings.push_back(own_spacings_[j]);
    }
    const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
    std::nth_element(spacings.begin(), middle, spacings.end());
    return static_cast<double>(*middle);
}

} // namespace meltpoint
