#include "run/scene_warnings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "run/wind_settings.h"
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

std::optional<std::string> idle_clamp(const Scene& scene)
{
    if (scene.solver != Solver::Dfsph || scene.physics.clamp_pressure) {
        return std::nullopt;
    }
    return "physics.clamp_pressure is off, but does nothing where solver is \"dfsph\", whose pressure is never below "
           "zero: \"wcsph\" and \"pbf\" heed it";
}

std::optional<std::string> idle_lid(const Scene& scene)
{
    if (scene.domain.lid_velocity == glm::vec3(0.0f) || scene.domain.wall_viscosity > 0.0f) {
        return std::nullopt;
    }
    return "domain.lid_velocity drags nothing along, for domain.wall_viscosity is 0: twice the fluid's holds it fast";
}

bool has_tension(const Scene& scene)
{
    const std::vector<Material> materials = scene_materials(scene).materials;
    return std::ranges::any_of(materials, [](const Material& material) { return material.tension > 0.0f; });
}

std::optional<std::string> idle_color(const Scene& scene)
{
    const auto solid = std::ranges::find_if(scene.solids, [](const SolidBody& body) {
        return body.erosion.strength_from == StrengthSource::Color && body.erosion.strength_contrast == 1.0f;
    });
    if (solid == scene.solids.end()) {
        return std::nullopt;
    }
    return fmt::format("solid.{0}.strength_from is \"color\", but does nothing while solid.{0}.strength_contrast is 1: "
                       "all colors are alike strong",
                       solid - scene.solids.begin());
}

/// The paper's tension is one for all fluids.
std::optional<std::string> unread_tension(const Scene& scene)
{
    const auto own = std::ranges::find_if(
        scene.fluids, [](const FluidBody& fluid) { return fluid.surface_tension.value_or(0.0f) > 0.0f; });
    if (scene.physics.tension_model != TensionModel::Paper || own == scene.fluids.end()) {
        return std::nullopt;
    }
    return fmt::format("fluid.{}.surface_tension does nothing where physics.tension_model is \"paper\", which takes "
                       "physics.surface_tension for every fluid",
                       own - scene.fluids.begin());
}

std::optional<std::string> idle_contact_angle(const Scene& scene)
{
    constexpr float neutral = 90.0f;
    const auto collider =
        std::ranges::find_if(scene.colliders, [](const ColliderBody& body) { return body.contact_angle != neutral; });
    const bool at_walls = scene.domain.contact_angle != neutral;
    if (scene.fluids.empty() || has_tension(scene) || (!at_walls && collider == scene.colliders.end())) {
        return std::nullopt;
    }
    const std::string key = at_walls ? "domain.contact_angle"
                                     : fmt::format("collider.{}.contact_angle", collider - scene.colliders.begin());
    if (scene.physics.tension_model == TensionModel::Paper) {
        return fmt::format("{} does nothing where physics.tension_model is \"paper\": \"si\" has contact angles", key);
    }
    return fmt::format("{} does nothing, for no fluid has surface tension: give it surface_tension (a liquid's own is "
                       "left out where particles are coarser than its capillary length)",
                       key);
}

/// Supports for which drops have been measured: in wider ones the outermost layer stays below rest density and bears no
/// pressure; in narrower ones a drop at rest gains energy until it flies apart (from 1.7 down, of 1.8 it comes to
/// rest), in the plane it throws off particles.
std::optional<std::string> unmeasured_tension(const Scene& scene)
{
    constexpr float widest = 2.6f;
    const float narrowest = scene.domain.dimensions == 2 ? 2.3f : 1.8f;
    const float ratio = scene.particles.support_ratio;
    if (!has_tension(scene) || (ratio >= narrowest && ratio <= widest)) {
        return std::nullopt;
    }
    return fmt::format(
        "particles.support_ratio is {:g}, for which surface tension comes out wrong by a fifth or breaks up the "
        "surface: take {:g} to {:g}",
        ratio, narrowest, widest);
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
    if (scene.physics.shifting <= 0.0f || !scene.emitters.empty() || !scene.colliders.empty() ||
        !scene.solids.empty()) {
        return std::nullopt;
    }
    const std::vector<Material> materials = scene_materials(scene).materials;
    double filled = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (particles.weight[i] == 0.0f) {
            continue; // not there yet
        }
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

/// How many times as dense as the fluid a body may be where pressure is solved for (measured on blocks that sink to
/// the bottom of a basin): denser ones bounce off the last fluid below them, ever higher.
double densest_body(Solver solver)
{
    return solver == Solver::Pbf ? 2.0 : 5.0;
}

/// Whether a block, seen along gravity, reaches from wall to wall.
bool shuts_domain(const Scene& scene, const BodyShape& shape)
{
    const auto* block = std::get_if<BlockShape>(&shape);
    if (block == nullptr) {
        return false;
    }
    const glm::vec3 share = (block->max - block->min) / (scene.domain.max - scene.domain.min);
    const glm::vec3 pull = glm::abs(scene.physics.gravity);
    float covered = 1.0f;
    for (int axis = 0; axis < static_cast<int>(scene.domain.dimensions); ++axis) {
        covered *= pull[axis] == std::max({pull.x, pull.y, pull.z}) ? 1.0f : share[axis];
    }
    return covered > 0.9f;
}

/// A solve takes bodies as they move already: fluid that cannot get out of their way would have to stop them at once.
std::optional<std::string> body_on_trapped_fluid(const Scene& scene)
{
    const FluidBody* fluid = eroding_fluid(scene);
    if (scene.solver == Solver::Wcsph || fluid == nullptr) {
        return std::nullopt;
    }
    const char* solver = scene.solver == Solver::Pbf ? "pbf" : "dfsph";
    for (std::size_t s = 0; s < scene.solids.size(); ++s) {
        const SolidBody& solid = scene.solids[s];
        if (solid.anchor != SolidAnchor::None || solid.wind_erodes) {
            continue;
        }
        const double ratio =
            static_cast<double>(solid.rest_density) / volume_as_solid(solid) / static_cast<double>(fluid->rest_density);
        if (ratio > densest_body(scene.solver)) {
            return fmt::format("solid.{} is {:.3g} times as dense as the fluid, and solver \"{}\" may let it bounce on "
                               "fluid that cannot get out of its way: up to {:g} times is well, or take \"wcsph\"",
                               s, ratio, solver, densest_body(scene.solver));
        }
        if (scene.solver == Solver::Pbf && shuts_domain(scene, solid.shape)) {
            return fmt::format(
                "solid.{} reaches from wall to wall, and solver \"pbf\" lets it bounce on the fluid below "
                "it, which cannot get out of its way: take \"wcsph\" or \"dfsph\"",
                s);
        }
    }
    return std::nullopt;
}

/// Columns of sand know of solids alone.
std::optional<std::string> wet_sand(const Scene& scene)
{
    const bool may_melt = std::ranges::any_of(
        scene.solids, [](const SolidBody& solid) { return !solid.wind_erodes && solid.becomes != SolidBecomes::Dust; });
    if (!has_sand(scene) || (scene.fluids.empty() && scene.emitters.empty() && !may_melt)) {
        return std::nullopt;
    }
    return "sand (wind_erodes) that slides does not push fluid aside: what is in its way is thrown up";
}

std::optional<std::string> idle_anchor(const Scene& scene)
{
    const auto held = std::ranges::find_if(
        scene.solids, [](const SolidBody& solid) { return solid.wind_erodes && solid.anchor != SolidBody{}.anchor; });
    if (held == scene.solids.end()) {
        return std::nullopt;
    }
    return fmt::format("solid.{}.anchor does nothing, for it is sand (wind_erodes): that lies on what is below it",
                       held - scene.solids.begin());
}

/// Wind that blows and takes no sand, on the steepest slope either.
std::optional<std::string> idle_wind(const Scene& scene)
{
    const std::optional<sim::WindSettings> wind = wind_settings(scene);
    if (!wind || wind->friction_velocity == 0.0) {
        return std::nullopt;
    }
    if (wind->flux == 0.0) {
        return "wind.flux is 0, so the wind takes no sand: 1.8 is that of dunes (wind.friction_velocity = 0 is no "
               "wind)";
    }
    const double gravity = glm::length(glm::dvec3(scene.physics.gravity));
    const double strongest =
        wind->friction_velocity * std::sqrt(static_cast<double>(shared::stress_on_slope(shared::STEEPEST_STRESS)));
    for (const sim::Sand& sand : wind->sand) {
        const double threshold = sand.erodes ? sim::threshold_friction_velocity(sand, wind->air_density, gravity) : 0.0;
        if (threshold > strongest) {
            return fmt::format("the wind takes none of the sand with grains of {:.4g} m (grain_size): it would need a "
                               "wind.friction_velocity of {:.4g} m/s, and {:.4g} m/s on the steepest slopes",
                               sand.grain_size, threshold, threshold * wind->friction_velocity / strongest);
        }
    }
    return std::nullopt;
}

} // namespace

std::vector<std::string> scene_warnings(const Scene& scene, const ParticleSet& particles)
{
    std::vector<std::string> warnings;
    for (const std::optional<std::string>& warning :
         {coarse_positions(scene), idle_viscosity(scene), idle_tension(scene), unread_tension(scene),
          idle_contact_angle(scene), unmeasured_tension(scene), idle_clamp(scene), idle_lid(scene), idle_color(scene),
          endless_fall(scene), shifted_surface(scene, particles), wet_sand(scene), body_on_trapped_fluid(scene),
          idle_anchor(scene), idle_wind(scene)}) {
        if (warning) {
            warnings.push_back(*warning);
        }
    }
    return warnings;
}

} // namespace meltpoint
