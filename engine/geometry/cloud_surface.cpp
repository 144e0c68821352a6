#include "geometry/cloud_surface.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/ranges.h>
#include <tbb/parallel_sort.h>

#include "core/aabb.h"
#include "core/error.h"
#include "geometry/local_planes.h"
#include "geometry/normal_orientation.h"

namespace meltpoint {

namespace {

constexpr std::size_t most_points = 10'000'000;
constexpr float smallest_extent = 1e-9f; // m, as of a mesh

bool is_known(const glm::vec3& normal)
{
    return normal != glm::vec3(0.0f);
}

/// Drops all but the first of points in the same place, which get the first normal that is known there. The others keep
/// their order.
PointCloud distinct(PointCloud cloud)
{
    std::vector<std::uint32_t> order(cloud.size());
    std::iota(order.begin(), order.end(), 0u);
    tbb::parallel_sort(order, [&](std::uint32_t a, std::uint32_t b) {
        const glm::vec3& p = cloud.positions[a];
        const glm::vec3& q = cloud.positions[b];
        return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z != q.z ? p.z < q.z : a < b;
    });
    std::vector<std::uint8_t> kept(cloud.size(), 0);
    for (std::size_t i = 0; i < order.size();) {
        const std::uint32_t first = order[i];
        kept[first] = 1;
        for (; i < order.size() && cloud.positions[order[i]] == cloud.positions[first]; ++i) {
            if (!is_known(cloud.normals[first])) {
                cloud.normals[first] = cloud.normals[order[i]];
            }
        }
    }
    const auto keep = [&](auto& values) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (kept[i] != 0) {
                values[count++] = values[i];
            }
        }
        values.resize(count);
    };
    keep(cloud.positions);
    keep(cloud.normals);
    keep(cloud.colors);
    return cloud;
}

void check_size(const PointCloud& cloud, std::string_view name)
{
    if (cloud.size() > most_points) {
        throw input_error("{}: the cloud has {} points, at most {} can be made into a surface: thin it out first", name,
                          cloud.size(), most_points);
    }
}

void check_extent(const PointCloud& cloud, std::string_view name)
{
    if (cloud.size() < 3) {
        throw input_error("{}: a surface takes at least three points in different places, the cloud has {}", name,
                          cloud.size());
    }
    Aabb box;
    for (const glm::vec3& position : cloud.positions) {
        box.extend(position);
    }
    const float extent = std::max({box.size().x, box.size().y, box.size().z});
    if (extent < smallest_extent) {
        throw input_error("{}: the cloud is {:g} m across, at least {:g} m are needed", name, extent, smallest_extent);
    }
}

/// Estimates the normals that are missing.
void complete_normals(std::vector<glm::vec3>& normals, std::span<const glm::vec3> points, const LocalPlanes& planes,
                      CloudFacts& facts)
{
    std::vector<std::uint8_t> given(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        given[i] = is_known(normals[i]) ? 1 : 0;
        normals[i] = given[i] != 0 ? normals[i] : planes.normal(i);
        facts.estimated += given[i] == 0 && is_known(normals[i]) ? 1 : 0;
        facts.unknown += is_known(normals[i]) ? 0 : 1;
    }
    if (facts.estimated > 0) {
        facts.pieces = orient_normals(points, planes, given, normals);
    }
}

} // namespace

std::string note_of(const CloudFacts& facts)
{
    std::vector<std::string> notes;
    if (facts.estimated > 0) {
        const std::string outside = facts.pieces == 0   ? "oriented as the given ones"
                                    : facts.pieces == 1 ? "oriented outward"
                                                        : fmt::format("oriented outward in {} pieces", facts.pieces);
        notes.push_back(fmt::format("{} of {} normals were missing: they are estimated from nearest neighbors and {}",
                                    facts.estimated, facts.points, outside));
    }
    if (facts.unknown > 0) {
        notes.push_back(fmt::format("{} points lie on lines and stay without a normal", facts.unknown));
    }
    if (facts.duplicates > 0) {
        notes.push_back(fmt::format("{} points in the place of another are left out", facts.duplicates));
    }
    if (facts.intensity_ignored) {
        notes.emplace_back("the fourth number of each line, an intensity, is ignored");
    }
    return fmt::format("{}", fmt::join(notes, "; "));
}

CloudSurface make_cloud_surface(PointCloud cloud, std::string_view name)
{
    check_size(cloud, name);
    CloudSurface surface;
    surface.facts.duplicates = cloud.size();
    surface.facts.intensity_ignored = cloud.intensity_ignored;
    cloud.normals.resize(cloud.size(), glm::vec3(0.0f));
    cloud = distinct(std::move(cloud));
    surface.facts.points = cloud.size();
    surface.facts.duplicates -= cloud.size();
    check_extent(cloud, name);

    const LocalPlanes planes(cloud.positions);
    complete_normals(cloud.normals, cloud.positions, planes, surface.facts);
    surface.cells = CloudCells(cloud.positions, cloud.normals, planes);
    const std::vector<double>& areas = surface.cells.areas();
    surface.area = std::accumulate(areas.begin(), areas.end(), 0.0);
    if (!(surface.area > 0.0)) {
        throw input_error("{}: the points of the cloud lie on a line, which is no surface", name);
    }
    surface.cloud = std::move(cloud);
    return surface;
}

} // namespace meltpoint
