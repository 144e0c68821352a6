#include "run/plane_scene.h"

#include <variant>

namespace meltpoint {

namespace {

void lay_flat(BlockShape& block, float half_thickness)
{
    block.min.z = -half_thickness;
    block.max.z = half_thickness;
}

void lay_flat(SphereShape& ball, float /*half_thickness*/)
{
    ball.center.z = 0.0f;
}

void lay_flat(MeshShape& /*mesh*/, float /*half_thickness*/) {}

void lay_flat(JetShape& jet, float /*half_thickness*/)
{
    jet.center.z = 0.0f;
}

/// Of inflows and rain.
template <class Box>
void lay_flat(Box& box, float /*half_thickness*/)
{
    box.min.z = box.max.z = 0.0f;
}

/// Any of a body's shapes.
template <class... Shapes>
void lay_flat(std::variant<Shapes...>& shape, float half_thickness)
{
    std::visit([&](auto& its) { lay_flat(its, half_thickness); }, shape);
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
        for (EmitterBody& emitter : flat.emitters) {
            lay_flat(emitter.shape, half_thickness);
        }
        for (SinkBody& sink : flat.sinks) {
            lay_flat(sink.shape, half_thickness);
        }
        for (ColliderBody& collider : flat.colliders) {
            lay_flat(collider.shape, half_thickness);
        }
    }
    return flat;
}

} // namespace meltpoint
