#include "scene/scene_check.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/gtx/component_wise.hpp>

#include "core/error.h"
#include "scene/key_table.h"
#include "scene/materials.h"
#include "shared/emission.h"
#include "shared/sph_params.h"

namespace meltpoint {

namespace {

// A shape may stick out of the domain by this fraction of the domain, so that a sphere of radius 0.3 at height 0.3
// touches the floor at 0 although 0.3f - 0.3f is no safe bet after other arithmetic.
constexpr float ROUNDING = 1e-5f;

constexpr std::size_t MOST_BODIES = 1024;

std::string text(const glm::vec3& v)
{
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}

class SceneChecker {
public:
    SceneChecker(const Scene& scene, const KeyLocator& locate) : scene_(scene), locate_(locate) {}

    void check() const
    {
        check_keys();
        check_domain();
        check_periodic();
        check_lattices();
        check_time();
        check_camera();
        check_render();
        check_fluids();
        check_flow();
        check_heat();
        check_wind();
        check_hydraulic();
        check_plates("collider", scene_.colliders);
        check_plates("surface", scene_.surfaces);
        check_materials();
        if (is_flat()) {
            check_plane();
        }
    }

private:
    template <class... Args>
    [[noreturn]] void fail(std::string_view key, fmt::format_string<Args...> format, Args&&... args) const
    {
        const std::string where = locate_ ? locate_(key) : "scene " + to_toml({scene_.name});
        throw input_error("{}: key \"{}\" {}", where, key, fmt::format(format, std::forward<Args>(args)...));
    }

    template <class Owner>
    void check_key(const Key<Owner>& key, const std::string& prefix, const Owner& owner) const
    {
        const SceneValue value = key.get(owner);
        if (!accepts(key.rule, value)) {
            fail(prefix + std::string(key.name), "{}", complaint(key.rule, key.unit, value));
        }
    }

    void check_keys() const
    {
        for (const SceneKey& key : scene_keys()) {
            check_key(key, "", scene_);
        }
        for_each_body_list(scene_, [&](std::string_view name, const auto& bodies, const auto& keys) {
            for (std::size_t i = 0; i < bodies.size(); ++i) {
                for (const auto& key : keys) {
                    if (belongs_to(key, shape_name(bodies[i].shape))) {
                        check_key(key, fmt::format("{}.{}.", name, i), bodies[i]);
                    }
                }
            }
        });
    }

    [[nodiscard]] bool is_flat() const { return scene_.domain.dimensions == 2; }

    /// An extent; in two dimensions without that along z, which means nothing there: as long as the one along x.
    [[nodiscard]] glm::vec3 extent_of(const glm::vec3& min, const glm::vec3& max) const
    {
        const glm::vec3 size = max - min;
        return is_flat() ? glm::vec3(size.x, size.y, size.x) : size;
    }

    [[nodiscard]] std::string_view axes() const { return is_flat() ? "x and y" : "x, y and z"; }

    void check_box(const std::string& prefix, const glm::vec3& min, const glm::vec3& max) const
    {
        if (!glm::all(glm::greaterThan(extent_of(min, max), glm::vec3(0.0f)))) {
            fail(prefix + "max", "is {}, but must be above {}min = {} in {}", text(max), prefix, text(min), axes());
        }
    }

    /// A block, or a plate: one that is flat along one axis.
    void check_plate(const std::string& prefix, const BlockShape& block) const
    {
        glm::vec3 size = block.max - block.min;
        size.z = is_flat() ? 1.0f : size.z;
        const int flat = glm::compAdd(glm::ivec3(glm::equal(size, glm::vec3(0.0f))));
        if (!glm::all(glm::greaterThanEqual(size, glm::vec3(0.0f))) || flat > 1) {
            fail(prefix + "max", "is {}, but must be above {}min = {} in {} (equal in one of them: a plate)",
                 text(block.max), prefix, text(block.min), axes());
        }
    }

    void check_domain() const
    {
        const DomainSettings& domain = scene_.domain;
        check_box("domain.", domain.min, domain.max);
        const glm::vec3 size = extent_of(domain.min, domain.max);
        const float smallest = std::min({size.x, size.y, size.z});
        if (scene_.particles.spacing > smallest) {
            fail("particles.spacing", "is {} m, but must be at most the domain's smallest extent, {} m",
                 scene_.particles.spacing, smallest);
        }
    }

    /// Who lies in rows, and must.
    void check_lattices() const
    {
        for (std::size_t i = 0; i < scene_.fluids.size(); ++i) {
            check_lattice(fmt::format("fluid.{}.lattice", i), scene_.fluids[i]);
        }
        for (std::size_t i = 0; i < scene_.solids.size(); ++i) {
            const std::string key = fmt::format("solid.{}.lattice", i);
            check_lattice(key, scene_.solids[i]);
            if (scene_.solids[i].wind_erodes && scene_.solids[i].lattice != BodyLattice::Cubic) {
                fail(key, "is \"blue-noise\", but sand (wind_erodes) stands in columns: it must be \"cubic\"");
            }
        }
    }

    void check_lattice(const std::string& key, const FluidBody& body) const
    {
        if (body.lattice == BodyLattice::Cubic) {
            return;
        }
        if (glm::any(scene_.domain.periodic)) {
            fail(key, "is \"blue-noise\", which knows no domain.periodic: it must be \"cubic\" there");
        }
        if (is_flat()) {
            fail(key, "is \"blue-noise\", but must be \"cubic\" (then a square one) where domain.dimensions is 2");
        }
    }

    void check_periodic() const
    {
        const DomainSettings& domain = scene_.domain;
        const std::optional<NarrowAxis> narrow = find_narrow_axis(scene_);
        if (narrow && (narrow->periodic || !fluid_bodies(scene_).empty())) {
            fail(narrow->periodic ? "domain.periodic" : "domain.max", "makes a domain that {}", narrow->complaint);
        }
        if (is_flat() && domain.periodic.z) {
            fail("domain.periodic", "has z, which means nothing where domain.dimensions is 2");
        }
        if (domain.lid_velocity.y != 0.0f) {
            fail("domain.lid_velocity", "is {}, but must have no y: a lid moves along itself",
                 text(domain.lid_velocity));
        }
        if (domain.lid_velocity != glm::vec3(0.0f) && (!domain.walls || domain.periodic.y)) {
            fail("domain.lid_velocity", "is {}, but there is no wall at the top", text(domain.lid_velocity));
        }
        if (scene_.physics.shifting > 0.0f && scene_.solver == Solver::Pbf) {
            fail("physics.shifting", "is {}, but must be 0 of solver \"pbf\", which moves particles itself",
                 scene_.physics.shifting);
        }
    }

    void check_time() const
    {
        const TimeSettings& time = scene_.time;
        if (time.dt && *time.dt * time.frame_rate > 1.0f + ROUNDING) {
            fail("time.dt", "is {} s, but must be at most the time between two frames, 1/{} s", *time.dt,
                 time.frame_rate);
        }
    }

    void check_camera() const
    {
        const CameraSettings& camera = scene_.camera;
        if (scene_.render.light == glm::vec3(0.0f)) {
            fail("render.light", "is [0, 0, 0], but must have a direction");
        }
        if (camera.up == glm::vec3(0.0f)) {
            fail("camera.up", "is [0, 0, 0], but must have a direction");
        }
        if (!camera.eye || !camera.target) {
            return;
        }
        const glm::vec3 view = *camera.target - *camera.eye;
        if (view == glm::vec3(0.0f)) {
            fail("camera.target", "is {}, but must differ from camera.eye", text(*camera.target));
        }
        if (glm::length(glm::cross(glm::normalize(view), glm::normalize(camera.up))) < ROUNDING) {
            fail("camera.up", "is {}, but must not be parallel to the line from camera.eye to camera.target",
                 text(camera.up));
        }
    }

    void check_render() const
    {
        const std::optional<glm::vec2>& range = scene_.render.color_range;
        if (range && !(range->x < range->y)) {
            fail("render.color_range", "is [{}, {}], but its first number must be below its second", range->x,
                 range->y);
        }
    }

    void check_fluids() const
    {
        if (scene_.fluids.empty() && scene_.solids.empty() && scene_.emitters.empty() && scene_.surfaces.empty()) {
            fail("fluid", "is missing: a scene has at least one [[fluid]], [[solid]], [[emitter]] or [[surface]]");
        }
        check_filled("fluid", scene_.fluids);
        check_filled("solid", scene_.solids);
        for (std::size_t i = 0; i < scene_.solids.size(); ++i) {
            check_front(fmt::format("solid.{}.", i), scene_.solids[i].dissolve);
            check_solid_density(fmt::format("solid.{}.", i), scene_.solids[i]);
        }
    }

    void check_flow() const
    {
        check_number("emitter", scene_.emitters.size(), shared::MAX_EMITTERS);
        check_number("sink", scene_.sinks.size(), shared::MAX_SINKS);
        for (std::size_t i = 0; i < scene_.emitters.size(); ++i) {
            const EmitterBody& emitter = scene_.emitters[i];
            const std::string prefix = fmt::format("emitter.{}.", i);
            if (is_flat() && emitter.velocity.z != 0.0f) {
                fail(prefix + "velocity", "is {}, but must have no z where domain.dimensions is 2",
                     text(emitter.velocity));
            }
            if (emitter.stop && *emitter.stop < emitter.start) {
                fail(prefix + "stop", "is {} s, but must not be before {}start = {} s", *emitter.stop, prefix,
                     emitter.start);
            }
            std::visit([&](const auto& shape) { check_emitter(prefix, emitter, shape); }, emitter.shape);
        }
        for (std::size_t i = 0; i < scene_.sinks.size(); ++i) {
            if (const auto* block = std::get_if<BlockShape>(&scene_.sinks[i].shape)) {
                check_box(fmt::format("sink.{}.", i), block->min, block->max);
            }
        }
    }

    void check_heat() const
    {
        if (scene_.heat.sun_direction == glm::vec3(0.0f)) {
            fail("heat.sun_direction", "is [0, 0, 0], but must have a length");
        }
        for (std::size_t i = 0; i < scene_.fluids.size(); ++i) {
            check_temperature(fmt::format("fluid.{}.", i), scene_.fluids[i], false);
        }
        for (std::size_t i = 0; i < scene_.solids.size(); ++i) {
            check_temperature(fmt::format("solid.{}.", i), scene_.solids[i], true);
            if (scene_.solids[i].melts && scene_.solids[i].becomes == SolidBecomes::Dust) {
                fail(fmt::format("solid.{}.melts", i), "is true, but what melts becomes fluid, not \"dust\"");
            }
        }
        for (std::size_t i = 0; i < scene_.emitters.size(); ++i) {
            check_temperature(fmt::format("emitter.{}.", i), scene_.emitters[i].fluid, false);
        }
    }

    void check_wind() const
    {
        if (!has_sand(scene_)) {
            return;
        }
        const glm::vec3& gravity = scene_.physics.gravity;
        if (gravity == glm::vec3(0.0f)) {
            fail("physics.gravity", "is [0, 0, 0], but sand needs some to come down");
        }
        if (gravity.x != 0.0f || gravity.y > 0.0f || gravity.z != 0.0f) {
            fail("physics.gravity", "is {}, but sand (wind_erodes) comes down along y: it must be [0, -g, 0]",
                 text(gravity));
        }
        if (glm::length(glm::cross(scene_.wind.direction, gravity)) == 0.0f) {
            fail("wind.direction", "does not lead over the ground: it is along gravity, or has no length");
        }
        if (is_flat() && scene_.wind.direction.z != 0.0f) {
            fail("wind.direction", "leads out of the plane of two dimensions");
        }
        for (std::size_t i = 0; i < scene_.solids.size(); ++i) {
            const SolidBody& solid = scene_.solids[i];
            const std::string prefix = fmt::format("solid.{}.", i);
            if (solid.wind_erodes && solid.melts) {
                fail(prefix + "melts", "is true, but it is sand (wind_erodes), which does not melt");
            }
            if (solid.wind_erodes && solid.erosion.erodes) {
                fail(prefix + "erodes", "is true, but it is sand (wind_erodes), which no fluid carries off");
            }
            if (solid.wind_erodes && solid.dissolve.speed > 0.0f) {
                fail(prefix + "dissolve_speed", "is above 0, but it is sand (wind_erodes), which does not dissolve");
            }
        }
    }

    void check_solid_density(const std::string& prefix, const SolidBody& solid) const
    {
        constexpr double least = 0.75; // farther apart than the reach of their bonds, particles would be of no piece
        constexpr double most = 1.25;
        const double ratio = 1.0 / volume_as_solid(solid);
        if (ratio < least || ratio > most) {
            fail(prefix + "solid_density", "is {} kg/m^3, but must be {} to {} times {}rest_density = {} kg/m^3",
                 *solid.solid_density, least, most, prefix, solid.rest_density);
        }
        if (solid.wind_erodes && ratio != 1.0) {
            fail(prefix + "solid_density", "is {} kg/m^3, but sand (wind_erodes) has one density, {}rest_density = {}",
                 *solid.solid_density, prefix, solid.rest_density);
        }
    }

    void check_hydraulic() const
    {
        const FluidBody* fluid = eroding_fluid(scene_);
        for (std::size_t i = 0; i < scene_.solids.size(); ++i) {
            const SolidBody& solid = scene_.solids[i];
            const std::string prefix = fmt::format("solid.{}.", i);
            if (solid.erosion.strength_layers && *solid.erosion.strength_layers == glm::vec3(0.0f)) {
                fail(prefix + "strength_layers", "is [0, 0, 0], but must have a length");
            }
            if (solid.erosion.strength_from == StrengthSource::Color) {
                check_color_strength(prefix, solid);
            }
            if (!solid.erosion.erodes) {
                continue;
            }
            if (solid.becomes == SolidBecomes::Dust) {
                fail(prefix + "erodes", "is true, but what flow carries off is fluid, not \"dust\"");
            }
            if (solid.erosion.grain_size && (fluid == nullptr || fluid->rest_density >= solid.rest_density)) {
                fail(prefix + "grain_size",
                     "is {} m, but grains lie in a fluid that is lighter than {}rest_density = {} kg/m^3: {}",
                     *solid.erosion.grain_size, prefix, solid.rest_density,
                     fluid == nullptr ? "there is no [[fluid]] or [[emitter]]"
                                      : fmt::format("the first here has {} kg/m^3", fluid->rest_density));
            }
        }
    }

    void check_color_strength(const std::string& prefix, const SolidBody& solid) const
    {
        if (!std::holds_alternative<MeshShape>(solid.shape)) {
            fail(prefix + "strength_from",
                 "is \"color\", but only a shape \"mesh\" may have colors: those of its file");
        }
        if (!solid.erosion.erodes) {
            fail(prefix + "strength_from", "is \"color\", but {}erodes is false: only what flow erodes has a strength",
                 prefix);
        }
    }

    void check_temperature(const std::string& prefix, const FluidBody& body, bool is_solid) const
    {
        const float above = body.temperature.value_or(body.thermal.melting_point) - body.thermal.melting_point;
        if (is_solid ? above > 0.0f : above < 0.0f) {
            fail(prefix + "temperature",
                 "is {} C, but must be at {} the melting point, {} C, of what is {} at the start", *body.temperature,
                 is_solid ? "most" : "least", body.thermal.melting_point, is_solid ? "solid" : "fluid");
        }
    }

    void check_emitter(const std::string& prefix, const EmitterBody& emitter, const JetShape& jet) const
    {
        if (emitter.velocity == glm::vec3(0.0f)) {
            fail(prefix + "velocity", "is [0, 0, 0], but a jet has a direction and a speed");
        }
        check_thickness(prefix + "radius", glm::vec3(2.0f * jet.radius));
        check_inside(prefix + "center", jet.center, jet.center);
    }

    void check_emitter(const std::string& prefix, const EmitterBody& emitter, const InflowShape& inflow) const
    {
        const std::optional<int> axis = flat_axis(inflow, is_flat());
        if (!axis) {
            fail(prefix + "max", "is {}, but must be above {}min = {} in {} but one, in which they are equal",
                 text(inflow.max), prefix, text(inflow.min), axes());
        }
        if (emitter.velocity[*axis] == 0.0f) {
            fail(prefix + "velocity", "is {}, but must lead through the rectangle, which is flat along {}",
                 text(emitter.velocity), "xyz"[*axis]);
        }
        glm::vec3 extent = extent_of(inflow.min, inflow.max);
        extent[*axis] = extent[(*axis + 1) % 2]; // any other
        check_thickness(prefix + "max", is_flat() ? glm::vec3(extent[1 - *axis]) : extent);
        check_inside(prefix + "min", inflow.min, inflow.max);
    }

    void check_emitter(const std::string& prefix, const EmitterBody& /*emitter*/, const RainShape& rain) const
    {
        const glm::vec3 size = rain.max - rain.min;
        if (!(size.x >= 0.0f && size.y >= 0.0f && (size.z >= 0.0f || is_flat()))) {
            fail(prefix + "max", "is {}, but must not be below {}min = {} in {}", text(rain.max), prefix,
                 text(rain.min), axes());
        }
        check_inside(prefix + "min", rain.min, rain.max);
    }

    void check_number(std::string_view list, std::size_t count, std::size_t most) const
    {
        if (count > most) {
            fail(list, "is there {} times, but a scene has at most {} {}s", count, most, list);
        }
    }

    /// Bodies that are filled with particles.
    template <class Body>
    void check_filled(std::string_view name, const std::vector<Body>& bodies) const
    {
        check_number(name, bodies.size(), MOST_BODIES);
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const std::string prefix = fmt::format("{}.{}.", name, i);
            std::visit([&](const auto& shape) { check_shape(prefix, shape); }, bodies[i].shape);
        }
    }

    void check_front(const std::string& prefix, const DissolveFront& front) const
    {
        if (front.direction && *front.direction == glm::vec3(0.0f)) {
            fail(prefix + "dissolve_direction", "is {}, but must have a length", text(*front.direction));
        }
        if (front.direction && front.point) {
            fail(prefix + "dissolve_direction",
                 "is there beside {}dissolve_point, but a front runs along one or spreads from the other", prefix);
        }
        if (is_flat() && front.direction && front.direction->z != 0.0f) {
            fail(prefix + "dissolve_direction", "is {}, but must have no z where domain.dimensions is 2",
                 text(*front.direction));
        }
    }

    /// Bodies whose blocks may be plates. Where they lie is free: what of a collider sticks out of the domain is cut
    /// off, and what is left is checked once it is sampled.
    template <class Body>
    void check_plates(std::string_view name, const std::vector<Body>& bodies) const
    {
        check_number(name, bodies.size(), MOST_BODIES);
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            if (const auto* block = std::get_if<BlockShape>(&bodies[i].shape)) {
                check_plate(fmt::format("{}.{}.", name, i), *block);
            }
        }
    }

    /// What a plane has no room for.
    void check_plane() const
    {
        constexpr std::string_view flat = "where domain.dimensions is 2";
        if (scene_.domain.lid_velocity.z != 0.0f) {
            fail("domain.lid_velocity", "is {}, but must have no z {}", text(scene_.domain.lid_velocity), flat);
        }
        if (scene_.physics.gravity.z != 0.0f) {
            fail("physics.gravity", "is {}, but must have no z {}", text(scene_.physics.gravity), flat);
        }
        if (!scene_.surfaces.empty()) {
            fail("surface", "is there, but there are no [[surface]]s {}", flat);
        }
        for (std::size_t i = 0; i < scene_.fluids.size(); ++i) {
            const FluidBody& fluid = scene_.fluids[i];
            const std::string prefix = fmt::format("fluid.{}.", i);
            check_plane_shape(prefix, fluid.shape);
            if (fluid.velocity.z != 0.0f) {
                fail(prefix + "velocity", "is {}, but must have no z {}", text(fluid.velocity), flat);
            }
            if (fluid.velocity_gradient[0].z != 0.0f || fluid.velocity_gradient[1].z != 0.0f) {
                fail(prefix + "velocity_gradient", "leads out of the plane in its third row, which must be zero {}",
                     flat);
            }
            if (fluid.spin.x != 0.0f || fluid.spin.y != 0.0f) {
                fail(prefix + "spin", "is {}, but must be about z alone {}", text(fluid.spin), flat);
            }
        }
        for (std::size_t i = 0; i < scene_.solids.size(); ++i) {
            check_plane_shape(fmt::format("solid.{}.", i), scene_.solids[i].shape);
        }
        for (std::size_t i = 0; i < scene_.colliders.size(); ++i) {
            check_plane_shape(fmt::format("collider.{}.", i), scene_.colliders[i].shape);
        }
    }

    void check_plane_shape(const std::string& prefix, const BodyShape& shape) const
    {
        if (std::holds_alternative<MeshShape>(shape)) {
            fail(prefix + "shape", "is \"mesh\", but must be \"block\" or \"sphere\" where domain.dimensions is 2");
        }
    }

    void check_materials() const
    {
        const SceneMaterials materials = scene_materials(scene_);
        if (materials.materials.size() <= shared::MAX_MATERIALS) {
            return;
        }
        const auto fluid = std::ranges::find(materials.of_fluid, shared::MAX_MATERIALS);
        const auto collider = std::ranges::find(materials.of_collider, shared::MAX_MATERIALS);
        const auto solid = std::ranges::find(materials.of_solid, shared::MAX_MATERIALS);
        const auto emitter = std::ranges::find(materials.of_emitter, shared::MAX_MATERIALS);
        const std::string first_beyond =
            fluid != materials.of_fluid.end()   ? fmt::format("fluid.{}", fluid - materials.of_fluid.begin())
            : solid != materials.of_solid.end() ? fmt::format("solid.{}", solid - materials.of_solid.begin())
            : emitter != materials.of_emitter.end()
                ? fmt::format("emitter.{}", emitter - materials.of_emitter.begin())
                : fmt::format("collider.{}", collider - materials.of_collider.begin());
        fail(first_beyond,
             "makes {} different materials (fluids by rest density and color, colliders by friction and color, solids "
             "by both), but a "
             "scene has at most {}",
             materials.materials.size(), shared::MAX_MATERIALS);
    }

    void check_shape(const std::string& prefix, const BlockShape& block) const
    {
        check_box(prefix, block.min, block.max);
        check_thickness(prefix + "max", extent_of(block.min, block.max));
        check_inside(prefix + "min", block.min, block.max);
    }

    void check_shape(const std::string& prefix, const SphereShape& sphere) const
    {
        check_thickness(prefix + "radius", glm::vec3(2.0f * sphere.radius));
        check_inside(prefix + "center", sphere.center - sphere.radius, sphere.center + sphere.radius);
    }

    /// A mesh is checked once it is read.
    void check_shape(const std::string&, const MeshShape&) const {}

    void check_thickness(const std::string& key, const glm::vec3& extent) const
    {
        const float thinnest = std::min({extent.x, extent.y, extent.z});
        if (thinnest < scene_.particles.spacing * (1.0f - ROUNDING)) {
            fail(key, "makes the body {} m thin, but it must be at least particles.spacing = {} m to hold a particle",
                 thinnest, scene_.particles.spacing);
        }
    }

    void check_inside(const std::string& key, const glm::vec3& min, const glm::vec3& max) const
    {
        const DomainSettings& domain = scene_.domain;
        const glm::vec3 slack = ROUNDING * (domain.max - domain.min);
        const glm::bvec3 matters(true, true, !is_flat());
        const glm::bvec3 below = glm::lessThan(min, domain.min - slack);
        const glm::bvec3 above = glm::greaterThan(max, domain.max + slack);
        if (glm::any(below && matters) || glm::any(above && matters)) {
            fail(key, "puts the body in {} to {}, but it must lie inside the domain, {} to {}", text(min), text(max),
                 text(domain.min), text(domain.max));
        }
    }

    const Scene& scene_;
    const KeyLocator& locate_;
};

} // namespace

std::optional<int> flat_axis(const InflowShape& inflow, bool is_in_plane)
{
    const glm::vec3 size = inflow.max - inflow.min;
    std::optional<int> flat;
    for (int axis = 0; axis < (is_in_plane ? 2 : 3); ++axis) {
        if (size[axis] < 0.0f || (size[axis] == 0.0f && flat)) {
            return std::nullopt;
        }
        flat = size[axis] == 0.0f ? axis : flat;
    }
    return flat;
}

std::optional<NarrowAxis> find_narrow_axis(const Scene& scene)
{
    const glm::vec3 size = scene.domain.max - scene.domain.min;
    const auto least = static_cast<float>(2.0 * static_cast<double>(scene.particles.support_ratio) *
                                          static_cast<double>(scene.particles.spacing));
    for (int axis = 0; axis < static_cast<int>(scene.domain.dimensions); ++axis) {
        const bool periodic = scene.domain.periodic[axis];
        if ((scene.domain.walls || periodic) && !(size[axis] >= least)) {
            return NarrowAxis{periodic,
                              fmt::format("is {:.4g} m wide along {}, {}, where it must be at least two support radii, "
                                          "{:.4g} m (2 x particles.support_ratio x particles.spacing)",
                                          size[axis], "xyz"[axis], periodic ? "periodic" : "between walls", least)};
        }
    }
    return std::nullopt;
}

void validate_scene(const Scene& scene, const KeyLocator& locate)
{
    SceneChecker(scene, locate).check();
}

} // namespace meltpoint
