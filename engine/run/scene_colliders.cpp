#include "run/scene_colliders.h"

#include <utility>

#include "core/aabb.h"
#include "core/error.h"
#include "geometry/surface_sampling.h"
#include "run/placed_mesh.h"

namespace meltpoint {

namespace {

/// The points of collider `c`, wherever they lie.
std::vector<glm::vec3> sample_collider(const Scene& scene, std::size_t c, std::uint64_t limit)
{
    const ColliderBody& collider = scene.colliders[c];
    const TriangleMesh mesh = std::visit([](const auto& shape) { return placed_mesh(shape); }, collider.shape);
    const double spacing = static_cast<double>(collider.spacing) * static_cast<double>(scene.particles.spacing);
    const double count = surface_area(mesh) / (spacing * spacing);
    if (count > static_cast<double>(limit)) {
        throw input_error("{}: collider.{} needs about {:.0f} boundary particles, more than the device can hold, {}: "
                          "choose a larger collider.{}.spacing than {} or particles.spacing than {} m",
                          scene.name, c, count, limit, c, collider.spacing, scene.particles.spacing);
    }
    const SurfaceRequest request{
        .method = SurfaceMethod::BlueNoise, .amount = PointSpacing{spacing}, .seed = scene.seed + c};
    return sample_surface(mesh, request).cloud.positions;
}

} // namespace

std::vector<ColliderSamples> sample_colliders(const Scene& scene, std::uint64_t limit)
{
    const Aabb domain{scene.domain.min, scene.domain.max};
    std::vector<ColliderSamples> samples;
    std::uint64_t total = 0;
    for (std::size_t c = 0; c < scene.colliders.size(); ++c) {
        const ColliderBody& collider = scene.colliders[c];
        std::vector<glm::vec3> points = sample_collider(scene, c, limit);
        Aabb box;
        for (const glm::vec3& x : points) {
            box.extend(x);
        }
        std::erase_if(points, [&](const glm::vec3& x) { return !domain.contains(x); });
        if (points.empty()) {
            throw input_error(
                "{}: collider.{} lies outside the domain: in [{:.4g}, {:.4g}, {:.4g}] to [{:.4g}, {:.4g}, "
                "{:.4g}] m",
                scene.name, c, box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z);
        }
        total += points.size();
        samples.push_back({std::move(points), collider.solid ? placed_solid(collider.shape) : nullptr});
    }
    if (total > limit) {
        throw input_error("{}: the colliders need {} boundary particles, more than the device can hold, {}: choose a "
                          "larger particles.spacing than {} m",
                          scene.name, total, limit, scene.particles.spacing);
    }
    return samples;
}

} // namespace meltpoint
