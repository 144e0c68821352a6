#include "run/scene_colliders.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "core/aabb.h"
#include "core/error.h"
#include "core/log.h"
#include "core/overloaded.h"
#include "geometry/cloud_solid.h"
#include "geometry/cloud_surface.h"
#include "geometry/mesh_facts.h"
#include "geometry/plane_sampling.h"
#include "geometry/sunk_samples.h"
#include "geometry/surface_sampling.h"
#include "run/placed_mesh.h"

namespace meltpoint {

namespace {

double area_of(const TriangleMesh& mesh)
{
    return surface_area(mesh);
}

double area_of(const CloudSurface& cloud)
{
    return cloud.area;
}

/// The points on the surface of collider `c`, wherever they lie.
template <class Surface>
PointCloud sample_collider(const Scene& scene, std::size_t c, const Surface& surface, std::uint64_t limit)
{
    const ColliderBody& collider = scene.colliders[c];
    const double spacing = static_cast<double>(collider.spacing) * static_cast<double>(scene.particles.spacing);
    const double count = area_of(surface) / (spacing * spacing);
    if (count > static_cast<double>(limit)) {
        throw input_error("{}: collider.{} needs about {:.0f} boundary particles, more than the device can hold, {}: "
                          "choose a larger collider.{}.spacing than {} or particles.spacing than {} m",
                          scene.name, c, count, limit, c, collider.spacing, scene.particles.spacing);
    }
    const SurfaceRequest request{
        .method = SurfaceMethod::BlueNoise, .amount = PointSpacing{spacing}, .seed = scene.seed + c};
    return sample_surface(surface, request).cloud;
}

glm::dvec3 center_of(const BodyShape& shape)
{
    return std::visit(Overloaded{
                          [](const BlockShape& block) { return 0.5 * (glm::dvec3(block.min) + glm::dvec3(block.max)); },
                          [](const SphereShape& ball) { return glm::dvec3(ball.center); },
                          [](const MeshShape& mesh) { return glm::dvec3(mesh.position); },
                      },
                      shape);
}

bool is_inside_out(const TriangleMesh& mesh)
{
    return signed_volume(mesh) < 0.0 && mesh_facts(weld(mesh)).boundary_edges == 0;
}

/// The winding number in a closed surface is -1 where all of it is turned: it keeps no fluid out, whatever was asked.
void warn_of_inward(const Scene& scene, std::size_t c, std::string_view parts)
{
    log_warning(
        fmt::format("{}: the {} of collider.{} face inward: fluid may start inside of it", scene.name, parts, c));
}

/// Null for a shell.
std::shared_ptr<const Solid> inside_of(const Scene& scene, std::size_t c,
                                       const std::variant<TriangleMesh, CloudSurface>& surface)
{
    const ColliderBody& collider = scene.colliders[c];
    if (!collider.solid) {
        return nullptr;
    }
    if (const auto* cloud = std::get_if<CloudSurface>(&surface)) {
        auto solid = std::make_shared<CloudSolid>(*cloud);
        if (solid->is_inside_out()) {
            warn_of_inward(scene, c, "normals");
        }
        return solid;
    }
    if (is_inside_out(std::get<TriangleMesh>(surface))) {
        warn_of_inward(scene, c, "triangles");
    }
    return std::holds_alternative<MeshShape>(collider.shape) ? solid_in(surface) : placed_solid(collider.shape);
}

/// All points, wherever they lie.
ColliderSamples sample_space_collider(const Scene& scene, std::size_t c, double depth, const Aabb& open,
                                      std::uint64_t limit)
{
    const ColliderBody& collider = scene.colliders[c];
    const std::variant<TriangleMesh, CloudSurface> surface = placed_surface(collider.shape);
    const PointCloud cloud =
        std::visit([&](const auto& each) { return sample_collider(scene, c, each, limit); }, surface);
    std::shared_ptr<const Solid> inside = inside_of(scene, c, surface);
    std::vector<glm::vec3> points = inside != nullptr ? sink_samples(cloud, *inside, depth, open) : cloud.positions;
    return {std::move(points), center_of(collider.shape), std::move(inside)};
}

/// A rectangle's outline, `depth` inside of it where it is that thick. A side against the domain's border or beyond it
/// has no outside: it is moved away, so that the others reach the border.
std::vector<glm::vec3> sink_rectangle(const BlockShape& block, double depth, const Aabb& open, double spacing)
{
    const auto most = 0.25f * (glm::vec2(block.max) - glm::vec2(block.min));
    const glm::vec2 inward = glm::min(glm::vec2(static_cast<float>(depth)), most);
    const auto away = static_cast<float>(4.0 * spacing);
    const glm::bvec2 low = glm::greaterThan(glm::vec2(block.min), glm::vec2(open.min));
    const glm::bvec2 high = glm::lessThan(glm::vec2(block.max), glm::vec2(open.max));
    const glm::vec2 min = glm::vec2(block.min) + glm::mix(glm::vec2(-away), inward, low);
    const glm::vec2 max = glm::vec2(block.max) - glm::mix(glm::vec2(-away), inward, high);
    return outline_rectangle(min, max, spacing);
}

/// In two dimensions: an outline.
ColliderSamples sample_plane_collider(const Scene& scene, std::size_t c, double depth, const Aabb& open)
{
    const ColliderBody& collider = scene.colliders[c];
    const double spacing = static_cast<double>(collider.spacing) * static_cast<double>(scene.particles.spacing);
    ColliderSamples samples{.points = {}, .center = center_of(collider.shape), .inside = nullptr};
    if (const auto* ball = std::get_if<SphereShape>(&collider.shape)) {
        const auto radius = static_cast<double>(ball->radius);
        samples.points =
            outline_disk(ball->center, radius - (collider.solid ? std::min(depth, 0.5 * radius) : 0.0), spacing);
    } else if (const auto* block = std::get_if<BlockShape>(&collider.shape)) {
        const glm::vec2 size = glm::vec2(block->max) - glm::vec2(block->min);
        const bool thick = collider.solid && size.x > 0.0f && size.y > 0.0f;
        samples.points =
            thick ? sink_rectangle(*block, depth, open, spacing) : outline_rectangle(block->min, block->max, spacing);
    } else {
        throw input_error("{}: collider.{} is a mesh, but two dimensions have none", scene.name, c);
    }
    if (collider.solid) {
        samples.inside = placed_solid(collider.shape);
    }
    return samples;
}

/// Along which periodic axes a collider reaches from border to border, so that it has no ends there.
glm::bvec3 spans_of(const Scene& scene, std::size_t c)
{
    constexpr float rounding = 1e-5f;
    glm::bvec3 spans(false);
    if (const auto* block = std::get_if<BlockShape>(&scene.colliders[c].shape)) {
        for (int axis = 0; axis < 3; ++axis) {
            const float length = scene.domain.max[axis] - scene.domain.min[axis];
            spans[axis] =
                scene.domain.periodic[axis] && block->max[axis] - block->min[axis] >= length * (1.0f - rounding);
        }
    }
    return spans;
}

/// Along a periodic axis a collider comes in again on the other side, and fluid looks for it there, one period away and
/// no farther. `box` is that of its surface.
void check_reach(const Scene& scene, std::size_t c, const Aabb& box)
{
    const glm::bvec3 spans = spans_of(scene, c);
    for (int axis = 0; axis < static_cast<int>(scene.domain.dimensions); ++axis) {
        const float min = scene.domain.min[axis];
        const float max = scene.domain.max[axis];
        const float length = max - min;
        const bool touches = box.min[axis] <= max && box.max[axis] >= min;
        const bool is_near = box.min[axis] >= min - length && box.max[axis] <= max + length;
        if (scene.domain.periodic[axis] && !spans[axis] && !(touches && is_near)) {
            throw input_error("{}: collider.{} reaches from {:.4g} to {:.4g} m along {}, which is periodic from {:.4g} "
                              "to {:.4g} m: it must touch the domain and reach at most one period beyond it",
                              scene.name, c, box.min[axis], box.max[axis], "xyz"[axis], min, max);
        }
    }
}

/// The part of the domain that lies deeper than `depth` (m) behind its borders; along a periodic axis, all of space,
/// unless the collider has no ends there.
Aabb open_space(const Scene& scene, std::size_t c, double depth)
{
    const auto inset = static_cast<float>(depth);
    Aabb open{scene.domain.min + inset, scene.domain.max - inset};
    const glm::bvec3 spans = spans_of(scene, c);
    for (int axis = 0; axis < 3; ++axis) {
        if (scene.domain.periodic[axis] && !spans[axis]) {
            open.min[axis] = -std::numeric_limits<float>::infinity();
            open.max[axis] = std::numeric_limits<float>::infinity();
        }
    }
    return open;
}

/// Takes points that lie beyond a periodic border to where they come in again, and cuts off those that lie outside of
/// the domain or are the ends of a collider that has none.
void cut_off(const Scene& scene, std::size_t c, std::vector<glm::vec3>& points)
{
    const glm::vec3 min = scene.domain.min;
    const glm::vec3 max = scene.domain.max;
    const glm::bvec3 spans = spans_of(scene, c);
    for (glm::vec3& x : points) {
        for (int axis = 0; axis < 3; ++axis) {
            if (scene.domain.periodic[axis] && !spans[axis]) {
                const float length = max[axis] - min[axis];
                x[axis] -= length * std::floor((x[axis] - min[axis]) / length);
                x[axis] = std::min(x[axis], max[axis]); // rounding
            }
        }
    }
    std::erase_if(points, [&](const glm::vec3& x) {
        for (int axis = 0; axis < 3; ++axis) {
            const float end = spans[axis] ? 1e-5f * (max[axis] - min[axis]) : 0.0f;
            if (!(x[axis] >= min[axis] + end && x[axis] <= max[axis] - end)) {
                return true;
            }
        }
        return false;
    });
}

} // namespace

std::vector<ColliderSamples> sample_colliders(const Scene& scene, double depth, std::uint64_t limit)
{
    std::vector<ColliderSamples> samples;
    std::uint64_t total = 0;
    for (std::size_t c = 0; c < scene.colliders.size(); ++c) {
        const Aabb open = open_space(scene, c, depth);
        ColliderSamples sampled = scene.domain.dimensions == 2 ? sample_plane_collider(scene, c, depth, open)
                                                               : sample_space_collider(scene, c, depth, open, limit);
        std::vector<glm::vec3> points = std::move(sampled.points);
        const float sunk = sampled.inside != nullptr ? static_cast<float>(depth) : 0.0f;
        Aabb box; // of the surface
        for (const glm::vec3& x : points) {
            box.extend(x - sunk);
            box.extend(x + sunk);
        }
        check_reach(scene, c, box);
        cut_off(scene, c, points);
        if (points.empty()) {
            throw input_error("{}: the surface of collider.{} lies outside the domain: in [{:.4g}, {:.4g}, {:.4g}] to "
                              "[{:.4g}, {:.4g}, "
                              "{:.4g}] m",
                              scene.name, c, box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z);
        }
        total += points.size();
        samples.push_back({std::move(points), sampled.center, std::move(sampled.inside)});
    }
    if (total > limit) {
        throw input_error("{}: the colliders need {} boundary particles, more than the device can hold, {}: choose a "
                          "larger particles.spacing than {} m",
                          scene.name, total, limit, scene.particles.spacing);
    }
    return samples;
}

} // namespace meltpoint
