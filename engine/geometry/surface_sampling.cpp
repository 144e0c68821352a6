#include "geometry/surface_sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/parallel_for.h"
#include "geometry/cloud_candidates.h"
#include "geometry/mesh_candidates.h"
#include "geometry/sample_elimination.h"
#include "geometry/stratified_sampling.h"

namespace meltpoint {

namespace {

constexpr std::size_t candidates_a_stratum = 8;

/// What memory allows, candidates among it.
double most_points(SurfaceMethod method)
{
    return method == SurfaceMethod::Random ? 0x1p28 : 0x1p24;
}

std::size_t wanted_count(const SurfaceRequest& request, double area)
{
    double count = 0.0;
    if (const auto* spacing = std::get_if<PointSpacing>(&request.amount)) {
        if (!std::isfinite(spacing->meters) || spacing->meters <= 0.0) {
            throw input_error("the spacing of surface samples is {} m, but must be positive", spacing->meters);
        }
        count = std::max(std::round(area / (spacing->meters * spacing->meters)), 1.0);
    } else {
        count = static_cast<double>(std::get<PointCount>(request.amount).points);
    }
    const double most = most_points(request.method);
    if (!(count <= most)) {
        throw input_error("{:.0f} surface samples were asked for, at most {:.0f} are supported", count, most);
    }
    return static_cast<std::size_t>(count);
}

std::vector<std::uint32_t> choose_blue_noise(const SurfaceCandidates& candidates, std::size_t count, double area)
{
    std::vector<glm::vec3> points(elimination_candidates(count));
    std::vector<glm::vec3> normals(points.size());
    parallel_for(points.size(), [&](std::size_t i) {
        const SurfaceCandidates::Placed candidate = candidates[i];
        points[i] = candidate.position;
        normals[i] = candidate.side;
    });
    // 2 r_max: points this far apart on a plane are the corners of equilateral triangles.
    const double spacing = 2.0 * std::sqrt(area / (2.0 * std::numbers::sqrt3 * static_cast<double>(count)));
    return eliminate_samples({.points = points, .normals = normals, .keep = count, .spacing = spacing});
}

SurfaceSamples sample(const SurfaceCandidates& candidates, double area, const SurfaceRequest& request)
{
    SurfaceSamples samples;
    samples.area = area;
    const std::size_t count = wanted_count(request, area);
    samples.spacing = count == 0 ? 0.0 : std::sqrt(area / static_cast<double>(count));
    switch (request.method) {
    case SurfaceMethod::Random:
        samples.cloud = candidates.cloud(count);
        break;
    case SurfaceMethod::Stratified:
        samples.cloud = candidates.cloud(
            choose_stratified(candidates.positions(candidates_a_stratum * count), candidates_a_stratum, request.seed));
        break;
    case SurfaceMethod::BlueNoise:
        samples.cloud = candidates.cloud(choose_blue_noise(candidates, count, area));
        break;
    }
    return samples;
}

} // namespace

SurfaceSamples sample_surface(const TriangleMesh& mesh, const SurfaceRequest& request)
{
    return sample(MeshCandidates(mesh, request.seed), surface_area(mesh), request);
}

SurfaceSamples sample_surface(const CloudSurface& surface, const SurfaceRequest& request)
{
    return sample(CloudCandidates(surface, request.seed), surface.area, request);
}

} // namespace meltpoint
