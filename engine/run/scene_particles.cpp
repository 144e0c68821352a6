#include "run/scene_particles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "core/aabb.h"
#include "core/error.h"
#include "core/overloaded.h"
#include "geometry/plane_sampling.h"
#include "geometry/relaxation.h"
#include "geometry/volume_sampling.h"
#include "particles/boundary_distance.h"
#include "run/dissolve_front.h"
#include "run/emission_settings.h"
#include "run/placed_mesh.h"
#include "run/plane_scene.h"
#include "run/scene_colliders.h"
#include "run/taken_space.h"
#include "scene/materials.h"
#include "shared/sph_params.h"

namespace meltpoint {

namespace {

// Spacings: fluid that has flowed rests so much nearer to a plane of boundary particles than a lattice would. Measured
// on settled blue noise: 0.03, 0.05 and 0.04 at H = 2, 2.6 and 3 d.
constexpr double settled = 0.04;

/// A body that is filled with particles, and what its errors call it.
struct FilledBody {
    std::string name; ///< "fluid.0"
    const FluidBody& body;
    const SolidBody* solid; ///< the same, if it is one
    std::uint32_t material;
    std::uint64_t seed;
};

/// The fluids, then the solids.
std::vector<FilledBody> filled_bodies(const Scene& scene, const SceneMaterials& materials)
{
    std::vector<FilledBody> bodies;
    for (std::size_t f = 0; f < scene.fluids.size(); ++f) {
        bodies.push_back(
            {fmt::format("fluid.{}", f), scene.fluids[f], nullptr, materials.of_fluid[f], scene.seed + bodies.size()});
    }
    for (std::size_t s = 0; s < scene.solids.size(); ++s) {
        bodies.push_back({fmt::format("solid.{}", s), scene.solids[s], &scene.solids[s], materials.of_solid[s],
                          scene.seed + bodies.size()});
    }
    return bodies;
}

/// m, of a body's particles. Those of a solid that melts to another volume have the mass of their fluid's all the same.
double spacing_of(const Scene& scene, const FilledBody& filled)
{
    const double volume = filled.solid != nullptr ? volume_as_solid(*filled.solid) : 1.0;
    return static_cast<double>(scene.particles.spacing) * std::pow(volume, 1.0 / scene.domain.dimensions);
}

/// A body as blue noise, relaxed as its kernel and the domain's walls will see it.
VolumeSamples sample_blue_noise(const Scene& scene, std::uint64_t seed, const Solid& solid, double spacing)
{
    VolumeRequest request{.lattice = Lattice::BlueNoise, .amount = PointSpacing{spacing}, .seed = seed};
    // Narrower kernels hardly see a fluid, wider ones see none of what is left uneven.
    request.relaxation.support_ratio = std::clamp(static_cast<double>(scene.particles.support_ratio), 2.0, 3.0);
    if (scene.domain.walls) {
        request.relaxation.mirrors = Aabb{scene.domain.min, scene.domain.max};
    }
    return sample_volume(solid, request);
}

VolumeSamples sample_plane_shape(const BodyShape& shape, double spacing)
{
    return std::visit(Overloaded{
                          [&](const BlockShape& block) { return sample_rectangle(block.min, block.max, spacing); },
                          [&](const SphereShape& ball) {
                              return sample_disk(ball.center, static_cast<double>(ball.radius), spacing);
                          },
                          [](const MeshShape&) -> VolumeSamples { throw input_error("two dimensions have no meshes"); },
                      },
                      shape);
}

/// How many particles a block gets along each axis, at about this spacing, so that their number suits its volume best.
glm::uvec3 block_counts(const BlockShape& block, double spacing)
{
    const glm::dvec3 ideal = (glm::dvec3(block.max) - glm::dvec3(block.min)) / spacing;
    const auto error = [&](const glm::uvec3& count) {
        const glm::dvec3 share = glm::dvec3(count) / ideal;
        return std::abs(share.x * share.y * share.z - 1.0);
    };
    glm::uvec3 best = glm::max(glm::round(ideal), 1.0);
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const glm::uvec3 up(corner & 1u, corner >> 1u & 1u, corner >> 2u);
        const glm::uvec3 count = glm::max(glm::uvec3(glm::floor(ideal)) + up, 1u);
        best = error(count) < error(best) - 1e-6 ? count : best;
    }
    return best;
}

VolumeSamples sample_shape(const Scene& scene, const FilledBody& filled, const Solid& solid)
{
    const FluidBody& body = filled.body;
    const double spacing = spacing_of(scene, filled);
    if (scene.domain.dimensions == 2) {
        return sample_plane_shape(body.shape, spacing);
    }
    if (body.lattice == BodyLattice::BlueNoise) {
        return sample_blue_noise(scene, filled.seed, solid, spacing);
    }
    const bool swells = filled.solid != nullptr && volume_as_solid(*filled.solid) != 1.0;
    return std::visit(Overloaded{
                          [&](const BlockShape& block) {
                              const Aabb box{block.min, block.max};
                              return swells ? sample_block(box, block_counts(block, spacing))
                                            : sample_block(box, spacing);
                          },
                          [&](const SphereShape& ball) { return sample_sphere(ball.center, ball.radius, spacing); },
                          [&](const MeshShape&) { return sample_volume(solid, {.amount = PointSpacing{spacing}}); },
                      },
                      body.shape);
}

/// What errors say names the body and the file that it comes from.
VolumeSamples sample_body(const Scene& scene, const FilledBody& filled, const Solid& solid)
{
    try {
        return sample_shape(scene, filled, solid);
    } catch (const Error& error) {
        const auto* mesh = std::get_if<MeshShape>(&filled.body.shape);
        const std::string file = mesh != nullptr ? fmt::format(" ({})", mesh->mesh) : "";
        throw Error(error.kind(), fmt::format("{}: {}{}: {}", scene.name, filled.name, file, error.what()));
    }
}

/// Volume of a solid, measured only where its box could hold more than `limit` particles, else 0.
double volume_worth_measuring(const Solid& solid, double spacing, std::uint64_t limit)
{
    const glm::dvec3 size(solid.bounds().size());
    const bool could_be_too_many = size.x * size.y * size.z / std::pow(spacing, 3) > static_cast<double>(limit);
    return could_be_too_many ? solid.volume() : 0.0;
}

/// About how many particles fill a shape of the plane.
double expected_plane_particles(const FluidBody& body, double spacing)
{
    const double area =
        std::visit(Overloaded{
                       [](const BlockShape& block) {
                           const glm::dvec2 size = glm::dvec2(block.max) - glm::dvec2(block.min);
                           return size.x * size.y;
                       },
                       [](const SphereShape& ball) { return std::numbers::pi * std::pow(double{ball.radius}, 2); },
                       [](const MeshShape&) { return 0.0; },
                   },
                   body.shape);
    return area / (spacing * spacing);
}

/// About how many particles fill a shape; 0 for meshes that cannot need more than `limit`.
double expected_particles(const FluidBody& body, const Solid& solid, double spacing, std::uint64_t limit)
{
    const double volume = std::visit(
        Overloaded{
            [](const BlockShape& block) {
                const glm::dvec3 size = glm::dvec3(block.max) - glm::dvec3(block.min);
                return size.x * size.y * size.z;
            },
            [](const SphereShape& ball) { return 4.0 / 3.0 * std::numbers::pi * std::pow(double{ball.radius}, 3); },
            [&](const MeshShape&) { return volume_worth_measuring(solid, spacing, limit); },
        },
        body.shape);
    return volume / std::pow(spacing, 3);
}

void check_inside(const Scene& scene, const VolumeSamples& samples, const std::string& name)
{
    Aabb box;
    for (const glm::vec3& position : samples.positions) {
        box.extend(position);
    }
    const Aabb domain{scene.domain.min, scene.domain.max};
    if (!domain.contains(box.min) || !domain.contains(box.max)) {
        throw input_error("{}: {} reaches outside the domain: its particles lie in [{:.4g}, {:.4g}, {:.4g}] to "
                          "[{:.4g}, {:.4g}, {:.4g}] m",
                          scene.name, name, box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z);
    }
}

[[noreturn]] void throw_too_many(const Scene& scene, double count, std::uint64_t limit)
{
    throw input_error("{}: about {:.0f} particles are more than the device can hold, {}: choose a larger "
                      "particles.spacing than {} m",
                      scene.name, count, limit, scene.particles.spacing);
}

/// The least distance of neighbors in a filled shape, m.
float least_distance(const FluidBody& body, const VolumeSamples& samples, double spacing, std::uint32_t dimensions)
{
    double least = samples.spacing;
    if (body.lattice == BodyLattice::BlueNoise) {
        least *= relaxed_radius * densest_packing;
    } else if (const auto* block = std::get_if<BlockShape>(&body.shape)) { // its spacing may differ from axis to axis
        const glm::dvec3 size = glm::dvec3(block->max) - glm::dvec3(block->min);
        const glm::dvec3 step = size / glm::max(glm::round(size / spacing), 1.0);
        least = dimensions == 2 ? std::min(step.x, step.y) : std::min({step.x, step.y, step.z});
    }
    return static_cast<float>(least);
}

void add_body(ParticleSet& particles, const FilledBody& filled, const VolumeSamples& samples)
{
    const FluidBody& body = filled.body;
    std::uint32_t attributes =
        shared::pack_attributes(filled.solid != nullptr ? shared::STATE_SOLID : shared::STATE_FLUID, filled.material);
    if (filled.solid != nullptr && filled.solid->becomes == SolidBecomes::Dust) {
        attributes |= shared::FLAG_CRUMBLES;
    }
    const double volume = filled.solid != nullptr ? volume_as_solid(*filled.solid) : 1.0; // over its fluid's
    const double density = static_cast<double>(body.rest_density) / volume;
    const std::size_t first = particles.size();
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
        particles.mass[first + i] = static_cast<float>(density * samples.particle_volume);
        particles.weight[first + i] = static_cast<float>(volume);
        particles.attributes[first + i] = attributes;
    }
}

void add_boundary(ParticleSet& particles, const std::vector<glm::vec3>& points, std::uint32_t material)
{
    const std::size_t first = particles.size();
    particles.resize(first + points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        particles.position[first + i] = points[i];
        particles.weight[first + i] = 0.0f; // the simulation's to find out
        particles.attributes[first + i] = shared::pack_attributes(shared::STATE_COLLIDER, material);
    }
}

/// The dead particles that an emitter will bring to life.
void add_slots(ParticleSet& particles, const shared::Emitter& emitter, const glm::vec3& place, std::uint32_t material,
               double mass)
{
    const std::size_t first = particles.size();
    particles.resize(first + emitter.slots);
    for (std::size_t i = first; i < particles.size(); ++i) {
        particles.position[i] = place;
        particles.velocity[i] = emitter.velocity;
        particles.mass[i] = static_cast<float>(mass);
        particles.weight[i] = 0.0f;
        particles.attributes[i] = shared::pack_attributes(shared::STATE_DEAD, material);
    }
}

void check_room(const Scene& scene, std::size_t emitter, std::size_t taken, std::uint32_t slots, std::uint64_t limit)
{
    if (taken + slots > limit) {
        throw input_error("{}: emitter.{} has {} particles, which are, with {} others, more than the device can hold, "
                          "{}: give it fewer with emitter.{}.particles",
                          scene.name, emitter, slots, taken, limit, emitter);
    }
}

} // namespace

SceneParticles make_scene_particles(const Scene& any_scene, std::uint64_t limit)
{
    const Scene scene = in_its_dimensions(any_scene);
    const bool flat = scene.domain.dimensions == 2;
    const double spacing = static_cast<double>(scene.particles.spacing);
    double expected = 0.0;
    std::vector<std::unique_ptr<Solid>> solids; // a scan takes long to be made into one
    const SceneMaterials materials = scene_materials(scene);
    const std::vector<FilledBody> bodies = filled_bodies(scene, materials);
    for (const FilledBody& filled : bodies) {
        solids.push_back(placed_solid(filled.body.shape));
        expected += flat ? expected_plane_particles(filled.body, spacing)
                         : expected_particles(filled.body, *solids.back(), spacing, limit);
    }
    if (expected > static_cast<double>(limit)) {
        throw_too_many(scene, expected, limit);
    }

    SceneParticles result;
    std::vector<float> release;
    const std::uint32_t kernel = scene.kernel == SphKernel::Wendland ? shared::KERNEL_WENDLAND : shared::KERNEL_PAPER;
    const double support_ratio = static_cast<double>(scene.particles.support_ratio);
    const double distance = boundary_distance(kernel, support_ratio, scene.domain.dimensions);
    const auto clearance = static_cast<float>(distance * spacing);
    // Fluid ends half a spacing from its outermost particles: there the surface shall be.
    const std::vector<ColliderSamples> colliders = sample_colliders(scene, (distance - 0.5 - settled) * spacing, limit);
    TakenSpace taken(glm::vec3(scene.domain.periodic) * (scene.domain.max - scene.domain.min));
    for (std::size_t c = 0; c < colliders.size(); ++c) {
        taken.add(fmt::format("collider.{}", c), colliders[c], clearance);
    }

    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const FilledBody& filled = bodies[b];
        VolumeSamples samples = sample_body(scene, filled, *solids[b]);
        check_inside(scene, samples, filled.name);
        const Pitch pitch{.nearest =
                              least_distance(filled.body, samples, spacing_of(scene, filled), scene.domain.dimensions),
                          .spacing = static_cast<float>(samples.spacing)};
        taken.clear(filled.name, samples.positions, pitch, result.notes);
        if (samples.positions.empty()) {
            throw input_error("{}: {}, so nothing is left of it", scene.name, result.notes.back());
        }
        if (result.particles.size() + samples.positions.size() > limit) {
            throw_too_many(scene, static_cast<double>(result.particles.size() + samples.positions.size()), limit);
        }
        if (b + 1 < bodies.size()) {
            taken.add(filled.name, samples.positions, pitch);
        }
        add_body(result.particles, filled, samples);
        release.resize(result.particles.size(), std::numeric_limits<float>::infinity());
        if (filled.solid != nullptr && filled.solid->dissolve.speed > 0.0f) {
            const std::vector<float> times = arrival_times(filled.solid->dissolve, samples.positions, filled.seed);
            std::ranges::copy(times, release.end() - static_cast<std::ptrdiff_t>(times.size()));
        }
    }
    const sim::EmissionSettings emission =
        emission_settings(scene, static_cast<std::uint32_t>(result.particles.size()));
    for (std::size_t e = 0; e < emission.emitters.size(); ++e) {
        const shared::Emitter& emitter = emission.emitters[e];
        check_room(scene, e, result.particles.size(), emitter.slots, limit);
        add_slots(result.particles, emitter, emission.points[emitter.first_point], materials.of_emitter[e],
                  emitted_mass(scene, scene.emitters[e]));
    }
    for (std::size_t c = 0; c < colliders.size(); ++c) {
        result.colliders.push_back({.first_id = static_cast<std::uint32_t>(result.particles.size()),
                                    .points = colliders[c].points,
                                    .center = colliders[c].center});
        add_boundary(result.particles, colliders[c].points, materials.of_collider[c]);
    }
    if (result.particles.size() > limit) {
        throw_too_many(scene, static_cast<double>(result.particles.size()), limit);
    }
    const bool has_front = std::ranges::any_of(release, [](float time) { return std::isfinite(time); });
    if (has_front || has_heat(scene) || has_hydraulic(scene) || has_sand(scene) || has_fragments(scene) ||
        !emission.empty()) {
        release.resize(result.particles.size(), std::numeric_limits<float>::infinity());
        result.particles.release_time = std::move(release);
    }
    return result;
}

ParticleSet make_particles(const Scene& scene, std::uint64_t limit)
{
    return make_scene_particles(scene, limit).particles;
}

} // namespace meltpoint
