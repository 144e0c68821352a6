#include "run/surface_splats.h"

#include "core/error.h"
#include "geometry/cloud_surface.h"
#include "geometry/surface_sampling.h"
#include "run/placed_mesh.h"

namespace meltpoint {

namespace {

SurfaceMethod surface_method(SplatMethod method)
{
    switch (method) {
    case SplatMethod::Random:
        return SurfaceMethod::Random;
    case SplatMethod::Stratified:
        return SurfaceMethod::Stratified;
    case SplatMethod::BlueNoise:
        break;
    }
    return SurfaceMethod::BlueNoise;
}

void check_count(const Scene& scene, std::uint64_t limit)
{
    std::uint64_t count = 0;
    for (const SurfaceBody& surface : scene.surfaces) {
        count += surface.count;
    }
    if (count > limit) {
        throw input_error("{}: the surfaces have {} splats, more than the device can hold, {}: choose a smaller "
                          "surface.0.count",
                          scene.name, count, limit);
    }
}

} // namespace

SurfaceSplats make_surface_splats(const Scene& scene, std::uint64_t limit)
{
    check_count(scene, limit);
    SurfaceSplats splats;
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
        const SurfaceBody& surface = scene.surfaces[s];
        const SurfaceRequest request{
            .method = surface_method(surface.method), .amount = PointCount{surface.count}, .seed = scene.seed + s};
        const SurfaceSamples samples =
            std::visit([&](const auto& each) { return sample_surface(each, request); }, placed_surface(surface.shape));
        const float radius = surface.splat_radius * static_cast<float>(samples.spacing);
        for (std::size_t i = 0; i < samples.cloud.size(); ++i) {
            splats.position_radius.emplace_back(samples.cloud.positions[i], radius);
            splats.normal.emplace_back(samples.cloud.normals[i], 0.0f);
            splats.color.emplace_back(surface.color, 1.0f);
        }
    }
    return splats;
}

} // namespace meltpoint
