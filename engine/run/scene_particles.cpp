#include "run/scene_particles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "core/aabb.h"
#include "core/error.h"
#include "geometry/volume_sampling.h"
#include "run/load_mesh.h"
#include "scene/materials.h"

namespace meltpoint {

namespace {

template <class... Fs>
struct Overloaded : Fs... {
    using Fs::operator()...;
};
template <class... Fs>
Overloaded(Fs...) -> Overloaded<Fs...>; // which clang 16 does not deduce by itself

/// Scaled to its size, turned about its center, its center put in its place.
TriangleMesh placed_mesh(const MeshShape& shape)
{
    TriangleMesh mesh = load_mesh(shape.mesh);
    const Aabb box = bounds(mesh);
    const glm::vec3 extent = box.size();
    const float largest = std::max({extent.x, extent.y, extent.z});
    const float scale = shape.size ? *shape.size / largest : 1.0f;
    glm::mat4 matrix = glm::translate(glm::mat4(1.0f), shape.position);
    matrix = glm::rotate(matrix, glm::radians(shape.rotation.z), glm::vec3(0.0f, 0.0f, 1.0f));
    matrix = glm::rotate(matrix, glm::radians(shape.rotation.y), glm::vec3(0.0f, 1.0f, 0.0f));
    matrix = glm::rotate(matrix, glm::radians(shape.rotation.x), glm::vec3(1.0f, 0.0f, 0.0f));
    matrix = glm::scale(matrix, glm::vec3(scale));
    matrix = glm::translate(matrix, -box.center());
    transform(mesh, matrix);
    return mesh;
}

VolumeSamples sample_shape(const FluidBody& body, double spacing)
{
    return std::visit(Overloaded{
                          [&](const BlockShape& block) {
                              return sample_block({block.min, block.max}, spacing);
                          },
                          [&](const SphereShape& ball) { return sample_sphere(ball.center, ball.radius, spacing); },
                          [&](const MeshShape& mesh) { return sample_volume(placed_mesh(mesh), spacing); },
                      },
                      body.shape);
}

/// Volume of a mesh, measured only where its box could hold more than `limit` particles, else 0.
double volume_worth_measuring(const MeshShape& shape, double spacing, std::uint64_t limit)
{
    const TriangleMesh mesh = placed_mesh(shape);
    const glm::dvec3 size(bounds(mesh).size());
    const bool could_be_too_many = size.x * size.y * size.z / std::pow(spacing, 3) > static_cast<double>(limit);
    return could_be_too_many ? measure_volume(mesh) : 0.0;
}

/// About how many particles fill a shape; 0 for meshes that cannot need more than `limit`.
double expected_particles(const FluidBody& body, double spacing, std::uint64_t limit)
{
    const double volume = std::visit(
        Overloaded{
            [](const BlockShape& block) {
                const glm::dvec3 size = glm::dvec3(block.max) - glm::dvec3(block.min);
                return size.x * size.y * size.z;
            },
            [](const SphereShape& ball) { return 4.0 / 3.0 * std::numbers::pi * std::pow(double{ball.radius}, 3); },
            [&](const MeshShape& mesh) { return volume_worth_measuring(mesh, spacing, limit); },
        },
        body.shape);
    return volume / std::pow(spacing, 3);
}

void check_inside(const Scene& scene, const VolumeSamples& samples, std::size_t fluid)
{
    Aabb box;
    for (const glm::vec3& position : samples.positions) {
        box.extend(position);
    }
    const Aabb domain{scene.domain.min, scene.domain.max};
    if (!domain.contains(box.min) || !domain.contains(box.max)) {
        throw input_error("{}: fluid.{} reaches outside the domain: its particles lie in [{:.4g}, {:.4g}, {:.4g}] to "
                          "[{:.4g}, {:.4g}, {:.4g}] m",
                          scene.name, fluid, box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z);
    }
}

[[noreturn]] void throw_too_many(const Scene& scene, double count, std::uint64_t limit)
{
    throw input_error("{}: about {:.0f} particles are more than the device can hold, {}: choose a larger "
                      "particles.spacing than {} m",
                      scene.name, count, limit, scene.particles.spacing);
}

} // namespace

ParticleSet make_particles(const Scene& scene, std::uint64_t limit)
{
    const double spacing = static_cast<double>(scene.particles.spacing);
    double expected = 0.0;
    for (const FluidBody& body : scene.fluids) {
        expected += expected_particles(body, spacing, limit);
    }
    if (expected > static_cast<double>(limit)) {
        throw_too_many(scene, expected, limit);
    }

    const SceneMaterials materials = scene_materials(scene);
    ParticleSet particles;
    for (std::size_t f = 0; f < scene.fluids.size(); ++f) {
        const FluidBody& body = scene.fluids[f];
        const VolumeSamples samples = sample_shape(body, spacing);
        check_inside(scene, samples, f);
        const std::size_t first = particles.size();
        if (first + samples.positions.size() > limit) {
            throw_too_many(scene, static_cast<double>(first + samples.positions.size()), limit);
        }
        particles.resize(first + samples.positions.size());

        glm::dvec3 center(0.0);
        for (const glm::vec3& position : samples.positions) {
            center += glm::dvec3(position) / static_cast<double>(samples.positions.size());
        }
        const glm::vec3 spin_center = body.spin_center.value_or(glm::vec3(center));
        for (std::size_t i = 0; i < samples.positions.size(); ++i) {
            const glm::vec3& x = samples.positions[i];
            particles.position[first + i] = x;
            particles.velocity[first + i] =
                body.velocity + body.velocity_gradient * x + glm::cross(body.spin, x - spin_center);
            particles.mass[first + i] = static_cast<float>(double{body.rest_density} * samples.particle_volume);
            particles.attributes[first + i] = shared::pack_attributes(shared::STATE_FLUID, materials.of_fluid[f]);
        }
    }
    return particles;
}

} // namespace meltpoint
