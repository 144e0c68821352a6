#include "run/scene_warnings.h"

#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "scene/liquids.h"
#include "scene/materials.h"
#include "shared/sph_params.h"

namespace meltpoint {

namespace {

/// Positions are floats: far from the origin they are too coarse for small particles.
std::optional<std::string> coarse_positions(const Scene& scene)
{
    constexpr double tolerable = 1e-3; // of a spacing
    const glm::vec3 reach = glm::max(glm::abs(scene.domain.min), glm::abs(scene.domain.max));
    const float farthest = std::max({reach.x, reach.y, reach.z});
    const double coarseness = static_cast<double>(farthest) * std::numeric_limits<float>::epsilon();
    if (coarseness <= tolerable * static_cast<double>(scene.particles.spacing)) {
        return std::nullopt;
    }
    return fmt::format("the domain reaches to {:.4g} m from the origin, where positions are good to "
                       "{:.2g} m, {:.2g} particle spacings: move it closer to the origin",
                       farthest, coarseness, coarseness / static_cast<double>(scene.particles.spacing));
}

/// A value that the scene bothers to set and nothing reads.
std::optional<std::string> idle_viscosity(const Scene& scene)
{
    if (scene.physics.viscosity == FluidPhysics{}.viscosity || fluid_bodies(scene).empty() ||
        !std::ranges::all_of(fluid_bodies(scene),
                             [](const FluidBody* fluid) { return fluid->viscosity.has_value(); })) {
        return std::nullopt;
    }
    return "physics.viscosity is used by no fluid: each has one of its own, by its key viscosity or its liquid";
}

std::optional<std::string> idle_tension(const Scene& scene)
{
    const bool own = std::ranges::all_of(fluid_bodies(scene), [](const FluidBody* fluid) {
        return fluid->surface_tension.has_value() || find_liquid(fluid->liquid) != nullptr;
    });
    if (scene.physics.surface_tension == 0.0f || scene.physics.tension_model != TensionModel::Si ||
        fluid_bodies(scene).empty() || !own) {
        return std::nullopt;
    }
    return "physics.surface_tension is used by no fluid: each has one of its own, by its key surface_tension or its "
           "liquid";
}

std::optional<std::string> idle_lid(const Scene& scene)
{
    if (scene.domain.lid_velocity == glm::vec3(0.0f) || scene.domain.wall_viscosity > 0.0f) {
        return std::nullopt;
    }
    return "domain.lid_velocity drags nothing along, for domain.wall_viscosity is 0: twice the fluid's holds it fast";
}

/// Supports for which drops have been measured: in wider ones the outermost layer stays below rest density and bears no
/// pressure, in the plane narrower ones throw off particles.
std::optional<std::string> unmeasured_tension(const Scene& scene)
{
    constexpr float widest = 2.6f;
    constexpr float narrowest_in_the_plane = 2.3f;
    const std::vector<Material> materials = scene_materials(scene).materials;
    const float ratio = scene.particles.support_ratio;
    const bool in_the_plane = scene.domain.dimensions == 2;
    if (std::ranges::none_of(materials, [](const Material& material) { return material.tension > 0.0f; }) ||
        (ratio <= widest && (!in_the_plane || ratio >= narrowest_in_the_plane))) {
        return std::nullopt;
    }
    return fmt::format(
        "particles.support_ratio is {:g}, for which surface tension comes out wrong by a fifth or breaks up the "
        "surface: take {}",
        ratio, in_the_plane ? "2.3 to 2.6" : "at most 2.6");
}

/// The speed of sound has to suit the speed of the flow, of which nothing is known where gravity pulls on and on.
std::optional<std::string> endless_fall(const Scene& scene)
{
    if (scene.solver != Solver::Wcsph || scene.physics.speed_of_sound || fluid_bodies(scene).empty()) {
        return std::nullopt;
    }
    for (int axis = 0; axis < static_cast<int>(scene.domain.dimensions); ++axis) {
        if (scene.domain.periodic[axis] && scene.physics.gravity[axis] != 0.0f) {
            return fmt::format("physics.gravity pulls along {}, which is periodic, so the fall has no end, and the "
                               "automatic physics.speed_of_sound leaves it out: set it to 10 times the speed that the "
                               "flow will reach",
                               "xyz"[axis]);
        }
    }
    return std::nullopt;
}

/// Particles diffuse to where there are fewer: beyond a surface there are none.
std::optional<std::string> shifted_surface(const Scene& scene, const ParticleSet& particles)
{
    if (scene.physics.shifting <= 0.0f || !scene.colliders.empty() || !scene.solids.empty()) {
        return std::nullopt;
    }
    const std::vector<Material> materials = scene_materials(scene).materials;
    double filled = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        filled += static_cast<double>(particles.mass[i]) /
                  static_cast<double>(materials[shared::particle_material(particles.attributes[i])].rest_density);
    }
    const glm::dvec3 size = glm::dvec3(scene.domain.max) - glm::dvec3(scene.domain.min);
    const double share = filled / (size.x * size.y * (scene.domain.dimensions == 3 ? size.z : 1.0));
    if (share >= 0.95) {
        return std::nullopt;
    }
    return fmt::format("physics.shifting is for fluid that fills its domain, and this fills {:.2g} of it: it will "
                       "spread out at its free surface",
                       share);
}

} // namespace

std::vector<std::string> scene_warnings(const Scene& scene, const ParticleSet& particles)
{
    std::vector<std::string> warnings;
    for (const std::optional<std::string>& warning :
         {coarse_positions(scene), idle_viscosity(scene), idle_tension(scene), unmeasured_tension(scene),
          idle_lid(scene), endless_fall(scene), shifted_surface(scene, particles)}) {
        if (warning) {
            warnings.push_back(*warning);
        }
    }
    return warnings;
}

} // namespace meltpoint
