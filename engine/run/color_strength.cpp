#include "run/color_strength.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/color.h"
#include "core/error.h"
#include "core/overloaded.h"
#include "core/parallel_for.h"
#include "geometry/nearest_points.h"
#include "geometry/surface_sampling.h"
#include "run/placed_mesh.h"

namespace meltpoint {

namespace {

constexpr double most_points = 4e6; // of a surface: beyond, they lie farther apart

double linear(std::uint8_t encoded)
{
    return linear_from_srgb(encoded / 255.0);
}

SurfaceRequest request(double area, double spacing, std::uint64_t seed)
{
    return {.method = SurfaceMethod::Stratified,
            .amount = PointSpacing{std::max(0.5 * spacing, std::sqrt(area / most_points))},
            .seed = seed};
}

} // namespace

float color_strength(const glm::u8vec3& color, float contrast)
{
    const double luminance = 0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b); // BT.709
    return static_cast<float>(std::pow(static_cast<double>(contrast), 2.0 * luminance - 1.0));
}

PointCloud colored_surfaces(const Scene& scene, const SceneMaterials& materials, std::size_t material)
{
    const auto spacing = static_cast<double>(scene.particles.spacing);
    PointCloud all;
    for (std::size_t s = 0; s < scene.solids.size(); ++s) {
        if (materials.of_solid[s] != material) {
            continue;
        }
        const auto surface = placed_surface(scene.solids[s].shape);
        const PointCloud points =
            std::visit(Overloaded{
                           [&](const TriangleMesh& mesh) {
                               return sample_surface(mesh, request(surface_area(mesh), spacing, scene.seed)).cloud;
                           },
                           [&](const CloudSurface& cloud) {
                               return sample_surface(cloud, request(cloud.area, spacing, scene.seed)).cloud;
                           },
                       },
                       surface);
        if (points.colors.empty()) {
            const auto* mesh = std::get_if<MeshShape>(&scene.solids[s].shape);
            throw input_error("{}: solid.{}.strength_from is \"color\", but {} has none that are read: those of the "
                              "vertices of a mesh (.obj, .ply, .gltf, .glb), or of points (.ply, .xyz)",
                              scene.name, s, mesh != nullptr ? mesh->mesh : "its shape");
        }
        all.positions.insert(all.positions.end(), points.positions.begin(), points.positions.end());
        all.colors.insert(all.colors.end(), points.colors.begin(), points.colors.end());
    }
    return all;
}

std::vector<float> color_strengths(const PointCloud& surface, float contrast, std::span<const glm::vec3> places)
{
    const NearestPoints points(surface.positions);
    std::vector<float> found(places.size());
    parallel_for(places.size(), [&](std::size_t i) {
        found[i] = color_strength(surface.colors[points.nearest_to(places[i])], contrast);
    });
    return found;
}

} // namespace meltpoint
