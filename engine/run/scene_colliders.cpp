#include "run/scene_colliders.h"

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

} // namespace

std::vector<ColliderSamples> sample_colliders(const Scene& scene, double depth, std::uint64_t limit)
{
    const Aabb domain{scene.domain.min, scene.domain.max};
    const Aabb open{domain.min + static_cast<float>(depth), domain.max - static_cast<float>(depth)};
    std::vector<ColliderSamples> samples;
    std::uint64_t total = 0;
    for (std::size_t c = 0; c < scene.colliders.size(); ++c) {
        const ColliderBody& collider = scene.colliders[c];
        const std::variant<TriangleMesh, CloudSurface> surface = placed_surface(collider.shape);
        const PointCloud cloud =
            std::visit([&](const auto& each) { return sample_collider(scene, c, each, limit); }, surface);
        Aabb box;
        for (const glm::vec3& x : cloud.positions) {
            box.extend(x);
        }
        std::shared_ptr<const Solid> inside = inside_of(scene, c, surface);
        std::vector<glm::vec3> points = inside != nullptr ? sink_samples(cloud, *inside, depth, open) : cloud.positions;
        std::erase_if(points, [&](const glm::vec3& x) { return !domain.contains(x); });
        if (points.empty()) {
            throw input_error("{}: the surface of collider.{} lies outside the domain: in [{:.4g}, {:.4g}, {:.4g}] to "
                              "[{:.4g}, {:.4g}, "
                              "{:.4g}] m",
                              scene.name, c, box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z);
        }
        total += points.size();
        samples.push_back({std::move(points), center_of(collider.shape), std::move(inside)});
    }
    if (total > limit) {
        throw input_error("{}: the colliders need {} boundary particles, more than the device can hold, {}: choose a "
                          "larger particles.spacing than {} m",
                          scene.name, total, limit, scene.particles.spacing);
    }
    return samples;
}

} // namespace meltpoint
