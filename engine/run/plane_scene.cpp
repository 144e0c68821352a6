#include "run/plane_scene.h"

#include <variant>

namespace meltpoint {

namespace {

void lay_flat(BodyShape& shape, float half_thickness)
{
    if (auto* block = std::get_if<BlockShape>(&shape)) {
        block->min.z = -half_thickness;
        block->max.z = half_thickness;
    } else if (auto* ball = std::get_if<SphereShape>(&shape)) {
        ball->center.z = 0.0f;
    }
}

} // namespace

Scene in_its_dimensions(const Scene& scene)
{
    Scene flat = scene;
    if (scene.domain.dimensions == 2) {
        const double support_radius =
            static_cast<double>(scene.particles.support_ratio) * static_cast<double>(scene.particles.spacing);
        const float half_thickness = 0.5f * static_cast<float>(support_radius); // one cell of the grid, to the last bit
        flat.domain.min.z = -half_thickness;
        flat.domain.max.z = half_thickness;
        for (FluidBody& fluid : flat.fluids) {
            lay_flat(fluid.shape, half_thickness);
        }
        for (SolidBody& solid : flat.solids) {
            lay_flat(solid.shape, half_thickness);
        }
        for (ColliderBody& collider : flat.colliders) {
            lay_flat(collider.shape, half_thickness);
        }
    }
    return flat;
}

} // namespace meltpoint
