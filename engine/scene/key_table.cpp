#include "scene/key_table.h"

#include <string>
#include <type_traits>
#include <utility>

#include "scene/liquids.h"

namespace meltpoint {

namespace {

// --- C++ types <-> values ------------------------------------------------------------------------

double number(const SceneValue& value)
{
    const auto* integer = std::get_if<std::int64_t>(&value.data);
    return integer != nullptr ? static_cast<double>(*integer) : std::get<double>(value.data);
}

const SceneValue::Array& array(const SceneValue& value)
{
    return std::get<SceneValue::Array>(value.data);
}

/// How one type of field is written; Codec<T>::kind, to_value and from_value.
template <class T>
struct Codec;

template <>
struct Codec<bool> {
    static constexpr ValueKind kind = ValueKind::Boolean;
    static SceneValue to_value(bool field) { return {field}; }
    static bool from_value(const SceneValue& value) { return std::get<bool>(value.data); }
};

template <>
struct Codec<glm::bvec3> {
    static constexpr ValueKind kind = ValueKind::Boolean3;
    static SceneValue to_value(const glm::bvec3& field) { return {SceneValue::Array{{field.x}, {field.y}, {field.z}}}; }
    static glm::bvec3 from_value(const SceneValue& value)
    {
        const SceneValue::Array& values = array(value);
        return {std::get<bool>(values[0].data), std::get<bool>(values[1].data), std::get<bool>(values[2].data)};
    }
};

template <>
struct Codec<std::string> {
    static constexpr ValueKind kind = ValueKind::Text;
    static SceneValue to_value(const std::string& field) { return {field}; }
    static std::string from_value(const SceneValue& value) { return std::get<std::string>(value.data); }
};

template <class T>
    requires(std::is_unsigned_v<T> && !std::is_same_v<T, bool>)
struct Codec<T> {
    static constexpr ValueKind kind = ValueKind::Integer;
    static SceneValue to_value(T field)
    {
        // TOML has no whole numbers past 2^63: as a double such a field is reported as not allowed.
        return std::in_range<std::int64_t>(field) ? SceneValue{static_cast<std::int64_t>(field)}
                                                  : SceneValue{static_cast<double>(field)};
    }
    static T from_value(const SceneValue& value) { return static_cast<T>(std::get<std::int64_t>(value.data)); }
};

template <>
struct Codec<float> {
    static constexpr ValueKind kind = ValueKind::Number;
    static SceneValue to_value(float field) { return {static_cast<double>(field)}; }
    static float from_value(const SceneValue& value) { return static_cast<float>(number(value)); }
};

template <int N>
struct Codec<glm::vec<N, float>> {
    static constexpr ValueKind kind = N == 2 ? ValueKind::Vector2 : ValueKind::Vector3;
    static SceneValue to_value(const glm::vec<N, float>& field)
    {
        SceneValue::Array values;
        for (int i = 0; i < N; ++i) {
            values.push_back(Codec<float>::to_value(field[i]));
        }
        return {values};
    }
    static glm::vec<N, float> from_value(const SceneValue& value)
    {
        glm::vec<N, float> field;
        for (int i = 0; i < N; ++i) {
            field[i] = Codec<float>::from_value(array(value)[static_cast<std::size_t>(i)]);
        }
        return field;
    }
};

template <>
struct Codec<glm::mat3> { // rows in the file, columns in glm
    static constexpr ValueKind kind = ValueKind::Matrix3;
    static SceneValue to_value(const glm::mat3& field)
    {
        const glm::mat3 rows = glm::transpose(field);
        return {SceneValue::Array{Codec<glm::vec3>::to_value(rows[0]), Codec<glm::vec3>::to_value(rows[1]),
                                  Codec<glm::vec3>::to_value(rows[2])}};
    }
    static glm::mat3 from_value(const SceneValue& value)
    {
        const SceneValue::Array& rows = array(value);
        return glm::transpose(glm::mat3(Codec<glm::vec3>::from_value(rows[0]), Codec<glm::vec3>::from_value(rows[1]),
                                        Codec<glm::vec3>::from_value(rows[2])));
    }
};

template <class T>
struct Codec<std::optional<T>> {
    static constexpr ValueKind kind = Codec<T>::kind;
    static SceneValue to_value(const std::optional<T>& field)
    {
        return field ? Codec<T>::to_value(*field) : SceneValue{std::string("auto")};
    }
    static std::optional<T> from_value(const SceneValue& value)
    {
        return is_auto(value) ? std::nullopt : std::optional<T>(Codec<T>::from_value(value));
    }
};

template <class T>
constexpr bool is_optional = false;
template <class T>
constexpr bool is_optional<std::optional<T>> = true;

// --- building keys -------------------------------------------------------------------------------

struct Range {
    double min = 0.0;
    double max = 0.0;
};

template <class Owner, class Field>
using FieldType = std::remove_cvref_t<std::invoke_result_t<Field, Owner&>>;

/// A key whose type follows from its field.
template <class Owner, class Field>
Key<Owner> key(std::string_view name, Field field, std::string_view unit, Range range, std::string_view description)
{
    using T = FieldType<Owner, Field>;
    return {.name = name,
            .unit = unit,
            .description = description,
            .rule = {Codec<T>::kind, range.min, range.max, {}, is_optional<T>},
            .get = [field](const Owner& owner) { return Codec<T>::to_value(field(owner)); },
            .set =
                [field](Owner& owner, const SceneValue& value) {
                    field(owner) = Codec<T>::from_value(value);
                }};
}

/// A key of true or false.
template <class Owner, class Field>
Key<Owner> flag(std::string_view name, Field field, std::string_view description)
{
    return key<Owner>(name, field, "", {}, description);
}

/// A key whose value is one of some words.
template <class Owner, class Field>
Key<Owner> choice(std::string_view name, Field field,
                  std::vector<std::pair<std::string_view, FieldType<Owner, Field>>> words, std::string_view description)
{
    Key<Owner> result{.name = name, .description = description, .rule = {.kind = ValueKind::Choice}};
    for (const auto& [word, meaning] : words) {
        result.rule.choices.push_back(word);
    }
    result.get = [field, words](const Owner& owner) {
        for (const auto& [word, meaning] : words) {
            if (meaning == field(owner)) {
                return SceneValue{std::string(word)};
            }
        }
        return SceneValue{std::string("?")}; // no enumerator of the field: the rule turns it down
    };
    result.set = [field, words](Owner& owner, const SceneValue& value) {
        for (const auto& [word, meaning] : words) {
            if (word == std::get<std::string>(value.data)) {
                field(owner) = meaning;
            }
        }
    };
    return result;
}

/// Which of its shapes a body has; setting it starts that shape afresh.
template <class Body, class... Shapes>
Key<Body> shape_key(std::string_view description, const std::variant<Shapes...>& /*any of them*/)
{
    return {.name = "shape",
            .required = true,
            .description = description,
            .rule = {.kind = ValueKind::Choice, .choices = {shape_word(Shapes{})...}},
            .get = [](const Body& body) { return SceneValue{std::string(shape_name(body.shape))}; },
            .set =
                [](Body& body, const SceneValue& value) {
                    const auto start_if_named = [&](auto shape) {
                        if (std::get<std::string>(value.data) == shape_word(shape)) {
                            body.shape = std::move(shape);
                        }
                    };
                    (start_if_named(Shapes{}), ...);
                }};
}

/// The same of the body's own shapes.
template <class Body>
Key<Body> shape_key(std::string_view description)
{
    return shape_key<Body>(description, Body{}.shape);
}

template <class Body>
Key<Body> required_of(std::string_view shape, Key<Body> body_key)
{
    body_key.shape = shape;
    body_key.required = true;
    return body_key;
}

template <class Body>
Key<Body> optional_of(std::string_view shape, Key<Body> body_key)
{
    body_key.shape = shape;
    return body_key;
}

// --- the tables ----------------------------------------------------------------------------------

// clang-format off
// NOLINTBEGIN(bugprone-macro-parentheses): members, not expressions
#define FIELD(member) [](auto& owner) -> auto& { return owner.member; }
#define SHAPE_FIELD(Shape, member) [](auto& body) -> auto& { return std::get<Shape>(body.shape).member; }
#define ITSELF [](auto& owner) -> auto& { return owner; }
// NOLINTEND(bugprone-macro-parentheses)

constexpr Range PLACE{-1e4, 1e4};  // m, from the origin
constexpr Range SPEED{-1e5, 1e5};  // m/s
constexpr Range UNIT{0.0, 1.0};

std::vector<SceneKey> make_scene_keys()
{
    const auto k = [](auto... arguments) { return key<Scene>(arguments...); };
    return {
        k("name", FIELD(name), "", Range{1, 200}, "what to call the scene and the folder of its frames; left out, a file goes by its own name"),
        k("description", FIELD(description), "", Range{0, 10000}, "what it shows"),
        choice<Scene>("solver", FIELD(solver), {{"wcsph", Solver::Wcsph}, {"dfsph", Solver::Dfsph}, {"pbf", Solver::Pbf}},
                      "wcsph: weakly compressible SPH, pressure from density by a state equation, small steps; dfsph: divergence-free SPH (Bender & Koschier 2015), pressure solved for, large steps; pbf: position based fluids (Macklin & Mueller 2013), positions moved until they keep the density, large steps, softer"),
        choice<Scene>("kernel", FIELD(kernel), {{"paper", SphKernel::Paper}, {"wendland", SphKernel::Wendland}},
                      "wendland: C2 for all, for pictures at particles.support_ratio = 2, for truth at 3; paper: poly6, spiky and viscosity kernels (Mueller et al. 2003), which need more viscosity to stay calm"),
        k("seed", FIELD(seed), "", Range{0, 1e18},
          "of all random numbers: the same seed gives the same run"),

        k("domain.min", FIELD(domain.min), "m", PLACE, "lowest corner of the box that holds everything"),
        k("domain.max", FIELD(domain.max), "m", PLACE, "highest corner"),
        k("domain.dimensions", FIELD(domain.dimensions), "", Range{2, 3}, "2: everything lies in the plane z = 0 and is seen from the front; a block is its rectangle in x and y, a sphere a disk, z of places means nothing, masses and forces are per meter of depth"),
        flag<Scene>("domain.walls", FIELD(domain.walls), "all faces are walls; without, leaving the domain ends the run, but for dust and sand in the air"),
        k("domain.periodic", FIELD(domain.periodic), "", Range{}, "axes along which the domain has no walls but begins again: what leaves through one border comes in through the other"),
        k("domain.wall_viscosity", FIELD(domain.wall_viscosity), "Pa s", Range{0, 1e4}, "of fluid against walls; 0 lets it slip freely, twice the fluid's holds it fast"),
        k("domain.contact_angle", FIELD(domain.contact_angle), "degrees", Range{0, 180}, "of fluid with surface tension at the walls, inside the fluid: below 90 it wets them (adhesion), above it beads off"),
        k("domain.lid_velocity", FIELD(domain.lid_velocity), "m/s", SPEED, "of the wall at the top, which drags fluid along where domain.wall_viscosity is above 0; without y"),

        k("particles.spacing", FIELD(particles.spacing), "m", Range{1e-5, 100}, "distance d of neighboring particles at rest; halving it makes eight times as many, in two dimensions four times"),
        k("particles.support_ratio", FIELD(particles.support_ratio), "", Range{1.25, 4}, "support radius H of the kernels, in spacings"),

        k("physics.gravity", FIELD(physics.gravity), "m/s^2", Range{-1e4, 1e4}, "acceleration of everything"),
        k("physics.viscosity", FIELD(physics.viscosity), "Pa s", Range{0, 1e4}, "dynamic, of fluids that have none of their own; water has 0.001, but at this resolution splashes look right with more"),
        choice<Scene>("physics.viscosity_model", FIELD(physics.viscosity_model), {{"auto", ViscosityModel::Auto}, {"explicit", ViscosityModel::Explicit}, {"implicit", ViscosityModel::Implicit}},
                      "explicit: a force like the others, which makes thick fluids take tiny steps (Mueller et al. 2003); implicit: solved for at the end of each step (Weiler et al. 2018), which bounds no step and leaves rotation alone; auto: implicit where the explicit one would shorten the steps"),
        k("physics.xsph", FIELD(physics.xsph), "", Range{0, 1}, "part of the difference between a particle's velocity and those around it that a step takes away (Monaghan 1989, Schechter & Bridson 2012); auto: 0.01 of pbf, else 0"),
        k("physics.vorticity_confinement", FIELD(physics.vorticity_confinement), "m/s", Range{0, 100}, "spins up vortices that the resolution wears away (Macklin & Mueller 2013): acceleration where vorticity falls off, over vorticity; a look, it adds energy and keeps no momentum"),
        k("physics.shifting", FIELD(physics.shifting), "", Range{0, 100}, "lets particles diffuse to where there are fewer (Lind et al. 2012); in units of H/2 times the speed expected of this scene, 5 keeps closed flows even where physics.clamp_pressure is off; not for free surfaces, nor for pbf"),
        k("physics.surface_tension", FIELD(physics.surface_tension), "N/m", Range{0, 1e4}, "of fluids that have none of their own; water against air has 0.073"),
        choice<Scene>("physics.tension_model", FIELD(physics.tension_model), {{"si", TensionModel::Si}, {"paper", TensionModel::Paper}},
                      "si: a force in SI units from the curvature of the surface (Brackbill et al. 1992), with contact angles; paper: that of Mueller et al. 2003 with physics.surface_tension, a look and no measured force"),
        k("physics.tension_threshold", FIELD(physics.tension_threshold), "", Range{0, 100}, "of tension_model \"paper\", on the color gradient times H: particles below it are inside and feel no tension"),
        choice<Scene>("physics.state_equation", FIELD(physics.state_equation), {{"linear", StateEquation::Linear}, {"tait", StateEquation::Tait}},
                      "pressure from density: linear in it, or to the power of gamma"),
        k("physics.speed_of_sound", FIELD(physics.speed_of_sound), "m/s", Range{1e-3, 1e5}, "stiffness of the fluid; auto: 10 times the speed expected of this scene"),
        k("physics.gamma", FIELD(physics.gamma), "", Range{1, 20}, "exponent of the Tait equation"),
        k("physics.background_pressure", FIELD(physics.background_pressure), "Pa", Range{0, 1e9}, "added to every pressure"),
        flag<Scene>("physics.clamp_pressure", FIELD(physics.clamp_pressure), "no pressure below zero, which would clump particles at a free surface; of dfsph it never is"),

        k("solve.density_error", FIELD(solve.density_error), "", Range{1e-6, 0.1}, "mean of rho/rho0 - 1, where positive, at which a step's density solve ends; auto: 0.0005, of pbf, which is soft, 0.01"),
        k("solve.divergence_error", FIELD(solve.divergence_error), "", Range{1e-6, 0.1}, "dfsph: mean relative growth of density in a step, where positive, at which its divergence solve ends"),
        k("solve.max_iterations", FIELD(solve.max_iterations), "", Range{1, 1000}, "of a solve for pressure; ending there without having met the error is reported"),
        k("solve.viscosity_error", FIELD(solve.viscosity_error), "", Range{1e-6, 0.1}, "implicit viscosity: what may be left over of the viscous forces, relative, root mean square, for a step's solve to end"),
        k("solve.viscosity_iterations", FIELD(solve.viscosity_iterations), "", Range{1, 1000}, "of that solve; ending there without having met the error is reported"),

        k("pbf.substeps", FIELD(pbf.substeps), "", Range{1, 100}, "steps a frame, at least, where time.dt is auto"),
        k("pbf.iterations", FIELD(pbf.iterations), "", Range{1, 1000}, "of a step, always as many; auto: until solve.density_error is met, at most solve.max_iterations"),
        k("pbf.relaxation", FIELD(pbf.relaxation), "", Range{0, 100}, "how soft the density constraints are (constraint force mixing), in parts of what a full neighborhood responds with"),
        k("pbf.artificial_pressure", FIELD(pbf.artificial_pressure), "", Range{0, 10}, "keeps pairs of particles apart: at 0.4 spacings like a density too high by this part"),
        k("pbf.speed_cap", FIELD(pbf.speed_cap), "spacings", Range{0.05, 1}, "the farthest that a particle may move in a step; automatic steps are so short that 0.8 of it suffices, then what is faster is slowed down, and reported"),

        k("dust.wind", FIELD(dust.wind), "m/s", SPEED, "of the air that dust drifts with, once solids crumble"),
        k("dust.turbulence", FIELD(dust.turbulence), "m/s", Range{0, 1e3}, "root mean square velocity of its eddies, which the wind carries along"),
        k("dust.eddy_size", FIELD(dust.eddy_size), "m", Range{1e-4, 1e4}, "wavelength of the largest of them; the finest have a quarter of it"),
        k("dust.response_time", FIELD(dust.response_time), "s", Range{1e-4, 1e4}, "in which dust takes on most of the air's velocity: short for fine dust"),
        k("dust.life", FIELD(dust.life), "s", Range{1e-3, 1e6}, "in which dust shrinks to nothing; it is also gone where it leaves the domain"),

        k("heat.time_scale", FIELD(heat.time_scale), "", Range{1e-6, 1e9}, "seconds of heat in one of motion: ice in the sun recedes by some micrometers a second, so pictures take about 1000"),
        k("heat.sun", FIELD(heat.sun), "W/m^2", Range{0, 1e12}, "of the sun on a surface that faces it, once something melts"),
        k("heat.sun_direction", FIELD(heat.sun_direction), "", PLACE, "which way its light goes; of any length but 0"),
        k("heat.air_temperature", FIELD(heat.air_temperature), "C", Range{-273.15, 1e5}, "of the air, which warms or cools solids where they are bare"),
        k("heat.air_transfer", FIELD(heat.air_transfer), "W/(m^2 K)", Range{0, 1e9}, "from the air to surfaces: 5 to 25 where it is still, 100 in the wind"),

        k("wind.direction", FIELD(wind.direction), "", PLACE, "which way the wind blows over sand, level; of any length but 0"),
        k("wind.friction_velocity", FIELD(wind.friction_velocity), "m/s", Range{0, 10}, "u*, the root of the wind's shear stress on the ground over the air's density; 0: no wind. Sand of 0.25 mm moves from 0.28 on"),
        k("wind.roughness_length", FIELD(wind.roughness_length), "m", Range{1e-7, 1}, "z0 of the wind's profile over the height z, u*/0.4 ln(z/z0)"),
        k("wind.air_density", FIELD(wind.air_density), "kg/m^3", Range{1e-3, 1e3}, "of the air"),
        k("wind.flux", FIELD(wind.flux), "", Range{0, 100}, "C of Bagnold's sand flux: 1.5 where grains are all alike, 1.8 on dunes, 2.8 where they are of many sizes"),
        k("wind.hop_length", FIELD(wind.hop_length), "m", Range{1e-4, 1e3}, "how far a grain hops over flat ground, on average: at least 4 particle spacings"),
        k("wind.time_scale", FIELD(wind.time_scale), "", Range{1e-6, 1e9}, "seconds of erosion in one of motion: a dune half a meter high moves by some centimeters an hour, so pictures take about 1000"),

        k("hydraulic.consistency", FIELD(hydraulic.consistency), "Pa s^n", Range{0, 1e6}, "of the flow that erodes: its shear stress is consistency (shear rate)^exponent, the shear rate the speed along the surface over a particle spacing"),
        k("hydraulic.exponent", FIELD(hydraulic.exponent), "", Range{0.01, 4}, "n of that power law: 1 is a Newtonian fluid, below it one that shear thins"),
        k("hydraulic.time_scale", FIELD(hydraulic.time_scale), "", Range{1e-6, 1e9}, "seconds of erosion in one of motion"),
        k("hydraulic.deposition_speed", FIELD(hydraulic.deposition_speed), "m/s", Range{0, 1e3}, "slower sediment that lies on a solid or the floor is at rest; 0: none ever is"),
        k("hydraulic.deposition_time", FIELD(hydraulic.deposition_time), "s", Range{1e-4, 1e4}, "of rest, after which it is solid again"),

        k("time.dt", FIELD(time.dt), "s", Range{1e-9, 1}, "step; auto: as long as stability allows, chosen anew for every step, the last of a frame ending at its time"),
        k("time.frame_rate", FIELD(time.frame_rate), "1/s", Range{1e-2, 1e6}, "frames in a second of simulated time"),
        k("time.frames", FIELD(time.frames), "", Range{1, 1e6}, "number of frames, frame 0 (the initial state) included"),

        choice<Scene>("camera.projection", FIELD(camera.projection), {{"auto", Projection::Auto}, {"perspective", Projection::Perspective}, {"orthographic", Projection::Orthographic}},
                      "orthographic: a 2D view without foreshortening; auto: perspective, in two dimensions orthographic"),
        k("camera.eye", FIELD(camera.eye), "m", PLACE, "where the camera is; auto: where it sees the whole domain"),
        k("camera.target", FIELD(camera.target), "m", PLACE, "what it looks at; auto: the center of the domain's lower half, in two dimensions the domain's center"),
        k("camera.up", FIELD(camera.up), "", PLACE, "the direction that is up in the picture; of any length but 0"),
        k("camera.field_of_view", FIELD(camera.field_of_view), "degrees", Range{1, 170}, "vertical, of the perspective camera"),
        k("camera.view_height", FIELD(camera.view_height), "m", Range{1e-4, 1e5}, "of the orthographic camera; auto: the domain's height"),

        k("render.width", FIELD(render.width), "pixels", Range{16, 8192}, "of a frame"),
        k("render.height", FIELD(render.height), "pixels", Range{16, 8192}, "of a frame"),
        choice<Scene>("render.color", FIELD(render.color), {{"material", ColorMode::Material}, {"density", ColorMode::Density}, {"speed", ColorMode::Speed}, {"pressure", ColorMode::Pressure}},
                      "what the colors show"),
        flag<Scene>("render.legend", FIELD(render.legend), "a color scale, drawn in every mode but material"),
        k("render.color_range", FIELD(render.color_range), "kg/m^3, m/s or Pa", Range{-1e12, 1e12}, "[lowest, highest] of the color scale; auto: fixed, from the scene"),
        flag<Scene>("render.floor", FIELD(render.floor), "a ground plane at the domain's lowest face; none in two dimensions"),
        k("render.splat_radius", FIELD(render.splat_radius), "spacings", Range{0.1, 5}, "of a fluid particle's sphere"),
        k("render.blend_time", FIELD(render.blend_time), "s", Range{0, 1e6}, "in which what was solid takes on the color of its fluid"),
        k("render.light", FIELD(render.light), "", PLACE, "the direction from the scene to the light; of any length but 0"),
        k("render.background", FIELD(render.background), "linear RGB", UNIT, "color behind everything"),
    };
}

/// "shape" and the keys of each shape.
template <class Body>
std::vector<Key<Body>> shape_keys(std::string_view description)
{
    const auto k = [](auto... arguments) { return key<Body>(arguments...); };
    return {
        shape_key<Body>(description),
        required_of("block", k("min", SHAPE_FIELD(BlockShape, min), "m", PLACE, "lowest corner")),
        required_of("block", k("max", SHAPE_FIELD(BlockShape, max), "m", PLACE, "highest corner")),
        required_of("sphere", k("center", SHAPE_FIELD(SphereShape, center), "m", PLACE, "center")),
        required_of("sphere", k("radius", SHAPE_FIELD(SphereShape, radius), "m", Range{1e-5, 1e4}, "radius")),
        required_of("mesh", k("mesh", SHAPE_FIELD(MeshShape, mesh), "", Range{1, 4096},
            "a file of a mesh, or of points (a scan), its path relative to the scene file, or builtin:teapot, builtin:rabbit, builtin:sphere, builtin:cube, builtin:torus, builtin:dune")),
        required_of("mesh", k("position", SHAPE_FIELD(MeshShape, position), "m", PLACE, "where the center of the mesh's bounding box goes")),
        optional_of("mesh", k("size", SHAPE_FIELD(MeshShape, size), "m", Range{1e-4, 1e4}, "largest extent after scaling; auto: the mesh's own units are meters")),
        optional_of("mesh", k("rotation", SHAPE_FIELD(MeshShape, rotation), "degrees", Range{-360, 360}, "about x, then y, then z, about its center")),
    };
}

template <class Body>
std::vector<Key<Body>> with_shape_keys(std::string_view description, const std::vector<Key<Body>>& others)
{
    std::vector<Key<Body>> keys = shape_keys<Body>(description);
    keys.insert(keys.end(), others.begin(), others.end());
    return keys;
}

template <class Body>
Key<Body> lattice_key(std::string_view description)
{
    return choice<Body>("lattice", FIELD(lattice), {{"cubic", BodyLattice::Cubic}, {"blue-noise", BodyLattice::BlueNoise}}, description);
}

/// Setting it gives the body's fluid, a FluidBody, the liquid's values.
template <class Body, class FluidOf>
Key<Body> liquid_key(FluidOf fluid_of, std::string_view description)
{
    std::vector<std::pair<std::string_view, std::string>> words{{"custom", "custom"}};
    for (const Liquid& liquid : liquids()) {
        words.emplace_back(liquid.name, liquid.name);
    }
    const auto field = [fluid_of](auto& body) -> auto& { return fluid_of(body).liquid; };
    Key<Body> result = choice<Body>("liquid", field, words, description);
    result.set = [set = result.set, fluid_of](Body& body, const SceneValue& value) {
        const Liquid* liquid = find_liquid(std::get<std::string>(value.data));
        if (liquid != nullptr) {
            set_liquid(fluid_of(body), *liquid);
        } else {
            set(body, value);
        }
    };
    return result;
}

/// What a body's fluid, a FluidBody, has to do with heat.
template <class Body, class FluidOf>
std::vector<Key<Body>> thermal_keys(FluidOf fluid_of)
{
    const auto k = [&](std::string_view name, auto member, std::string_view unit, Range range, std::string_view description) {
        return key<Body>(name, [fluid_of, member](auto& body) -> auto& { return fluid_of(body).thermal.*member; }, unit, range, description);
    };
    return {
        key<Body>("temperature", [fluid_of](auto& body) -> auto& { return fluid_of(body).temperature; }, "C", Range{-273.15, 1e5}, "at the start, if heat is followed; auto: the air's, or the melting point where that is on the way"),
        k("melting_point", &ThermalProperties::melting_point, "C", Range{-273.15, 1e5}, "where solid and fluid are in balance"),
        k("latent_heat", &ThermalProperties::latent_heat, "J/kg", Range{1, 1e9}, "that it takes to melt"),
        k("specific_heat", &ThermalProperties::specific_heat, "J/(kg K)", Range{1e-3, 1e7}, "of the fluid"),
        k("solid_specific_heat", &ThermalProperties::solid_specific_heat, "J/(kg K)", Range{1e-3, 1e7}, "of the solid"),
        k("conductivity", &ThermalProperties::conductivity, "W/(m K)", Range{0, 1e6}, "of the fluid"),
        k("solid_conductivity", &ThermalProperties::solid_conductivity, "W/(m K)", Range{0, 1e6}, "of the solid"),
    };
}

template <class Body>
std::vector<Key<Body>> joined(std::vector<Key<Body>> keys, const std::vector<Key<Body>>& more)
{
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
}

std::vector<FluidKey> make_fluid_keys()
{
    const auto k = [](auto... arguments) { return key<FluidBody>(arguments...); };
    return joined(with_shape_keys<FluidBody>("where the fluid starts; each shape has keys of its own", {
        liquid_key<FluidBody>(ITSELF, "what it is: gives rest_density, viscosity, surface_tension and color the values below, unless they stand in the scene; custom: nothing"),
        lattice_key<FluidBody>("how its particles lie at the start: in rows, or evenly without any, relaxed until the density varies by 1 %"),
        k("rest_density", FIELD(rest_density), "kg/m^3", Range{1e-3, 1e5}, "density without pressure"),
        k("viscosity", FIELD(viscosity), "Pa s", Range{0, 1e4}, "dynamic; auto: physics.viscosity. Between two fluids the harmonic mean is at work"),
        k("surface_tension", FIELD(surface_tension), "N/m", Range{0, 1e4}, "against air, of tension_model \"si\"; auto: the liquid's, where particles are finer than its capillary length sqrt(tension / (density gravity)), else 0; without a liquid physics.surface_tension"),
        k("velocity", FIELD(velocity), "m/s", SPEED, "at the start, of the whole body"),
        k("velocity_gradient", FIELD(velocity_gradient), "1/s", SPEED, "rows of a matrix; the matrix times the position adds to the velocity"),
        k("spin", FIELD(spin), "rad/s", SPEED, "spin x (position - spin_center) adds to the velocity"),
        k("spin_center", FIELD(spin_center), "m", PLACE, "what it spins about; auto: the body's center"),
        k("color", FIELD(color), "linear RGB", UNIT, "in render.color = \"material\""),
    }), thermal_keys<FluidBody>(ITSELF));
}

std::vector<SolidKey> make_solid_keys()
{
    const auto k = [](auto... arguments) { return key<SolidBody>(arguments...); };
    return joined(with_shape_keys<SolidBody>("what it is; each shape has keys of its own", {
        liquid_key<SolidBody>(ITSELF, "what it turns into: gives rest_density, viscosity, surface_tension and fluid_color the values of a liquid, unless they stand in the scene; custom: nothing"),
        lattice_key<SolidBody>("how its particles lie: in rows, which leave a melting face a row at a time, or evenly without any, relaxed until the density varies by 1 % (not in the plane, in a periodic domain, or of sand)"),
        k("rest_density", FIELD(rest_density), "kg/m^3", Range{1e-3, 1e5}, "density of the fluid"),
        k("solid_density", FIELD(solid_density), "kg/m^3", Range{1e-3, 1e5}, "density while it is solid, 0.75 to 1.25 times that of the fluid: what is freed takes on its fluid's volume within some hundred steps, what freezes or settles keeps it; ice has 917; auto: rest_density"),
        k("viscosity", FIELD(viscosity), "Pa s", Range{0, 1e4}, "dynamic, of the fluid; auto: physics.viscosity"),
        k("surface_tension", FIELD(surface_tension), "N/m", Range{0, 1e4}, "of the fluid, as of a [[fluid]]"),
        k("friction", FIELD(friction), "Pa s", Range{0, 1e4}, "viscosity of fluid against the solid; 0 lets it slip freely"),
        k("contact_angle", FIELD(contact_angle), "degrees", Range{0, 180}, "of fluid with surface tension at the solid, inside the fluid"),
        choice<SolidBody>("becomes", FIELD(becomes), {{"fluid", SolidBecomes::Fluid}, {"dust", SolidBecomes::Dust}}, "what it is freed as: fluid, or dust that drifts with the air of [dust]"),
        k("dissolve_speed", FIELD(dissolve.speed), "m/s", Range{0, 1e4}, "of a front that runs through the solid and frees it; 0: it stays solid"),
        k("dissolve_start", FIELD(dissolve.start), "s", Range{0, 1e6}, "when the front enters"),
        k("dissolve_direction", FIELD(dissolve.direction), "", PLACE, "which way the front runs, from the solid's first particle on; of any length but 0; auto: downward"),
        k("dissolve_point", FIELD(dissolve.point), "m", PLACE, "where the front spreads from instead, as a sphere that first touches the solid at dissolve_start; auto: it runs along dissolve_direction"),
        k("dissolve_roughness", FIELD(dissolve.roughness), "m", Range{0, 1e4}, "how far noise puts the front forward or back"),
        k("dissolve_grain", FIELD(dissolve.grain), "m", Range{1e-5, 1e4}, "size of that noise's coarsest lumps; the finest are an eighth of it"),
        flag<SolidBody>("melts", FIELD(melts), "it turns into fluid where it has taken in its latent heat, from the sun, the air ([heat]) or what touches it"),
        k("absorptivity", FIELD(absorptivity), "", UNIT, "part of the sun's power that its surface takes in"),
        flag<SolidBody>("wind_erodes", FIELD(wind_erodes), "it is sand: the wind of [wind] takes it, it comes down again, and slides where it lies too steep"),
        k("grain_density", FIELD(sand.grain_density), "kg/m^3", Range{1, 1e5}, "of the sand's mineral"),
        k("cohesion", FIELD(sand.cohesion), "N/m", Range{0, 1}, "between grains of sand: 1.65e-4 to 5e-4 (Shao & Lu 2000)"),
        k("repose_angle", FIELD(sand.repose_angle), "degrees", Range{1, 80}, "of the slope that sand stays on; it begins to slide where it lies a degree steeper"),
        flag<SolidBody>("erodes", FIELD(erosion.erodes), "flow along it carries it off: it becomes sediment, a fluid of its own density and viscosity ([hydraulic])"),
        k("erosion_threshold", FIELD(erosion.threshold), "Pa", Range{0, 1e9}, "shear stress of the flow up to which it holds, where it has no grain_size"),
        k("grain_size", FIELD(erosion.grain_size), "m", Range{1e-6, 10}, "of loose sand or gravel, which gives the threshold after Shields (Soulsby & Whitehouse 1997) in the scene's first fluid, auto: erosion_threshold; and what the wind has to lift, auto: 0.00025"),
        k("erosion_rate", FIELD(erosion.rate), "kg/(m^2 s Pa^a)", Range{0, 1e9}, "lost where the stress is 1 Pa above the threshold"),
        k("erosion_exponent", FIELD(erosion.exponent), "", Range{0.1, 4}, "a of that law: the loss is erosion_rate (stress - threshold)^a"),
        flag<SolidBody>("deposits", FIELD(erosion.deposits), "its sediment becomes solid again where it comes to rest"),
        k("strength_contrast", FIELD(erosion.strength_contrast), "", Range{1, 1000}, "its strongest parts are so many times as strong as usual, and its weakest by as much weaker; strength multiplies the threshold and divides the rate; 1: all are alike"),
        choice<SolidBody>("strength_from", FIELD(erosion.strength_from), {{"noise", StrengthSource::Noise}, {"color", StrengthSource::Color}}, "where it is strong: in lumps or layers of noise; or where its surface is bright, of shape \"mesh\" whose file, of a mesh (.obj, .ply, .gltf, .glb) or of points (.ply, .xyz), has colors of its vertices: white is strongest, black weakest, what lies inside is as its nearest surface"),
        k("strength_grain", FIELD(erosion.strength_grain), "m", Range{1e-5, 1e4}, "size of the coarsest lumps or layers of noise"),
        k("strength_layers", FIELD(erosion.strength_layers), "", PLACE, "direction across layers (strata), of any length but 0; auto: lumps"),
        choice<SolidBody>("anchor", FIELD(anchor), {{"ground", SolidAnchor::Ground}, {"all", SolidAnchor::All}, {"none", SolidAnchor::None}}, "what holds it in its place: the walls and colliders that it touches, so that pieces that are no longer connected to them break off and move as rigid bodies; all of itself, so that none ever does; nothing, so that it moves from the start, unless another solid holds it"),
        k("sliding_friction", FIELD(sliding_friction), "", Range{0, 100}, "Coulomb's coefficient, of its loose pieces on anything"),
        k("color", FIELD(solid_color), "linear RGB", UNIT, "of the solid, in render.color = \"material\"; gray in the other modes"),
        k("fluid_color", FIELD(color), "linear RGB", UNIT, "of the fluid"),
    }), thermal_keys<SolidBody>(ITSELF));
}

std::vector<EmitterKey> make_emitter_keys()
{
    const auto k = [](auto... arguments) { return key<EmitterBody>(arguments...); };
    return joined<EmitterBody>({
        shape_key<EmitterBody>("how fluid comes: jet, in layers out of a round nozzle that points along the velocity; inflow, in layers through a rectangle; rain, in single particles at random places; each has keys of its own"),
        required_of("jet", k("center", SHAPE_FIELD(JetShape, center), "m", PLACE, "of the nozzle")),
        required_of("jet", k("radius", SHAPE_FIELD(JetShape, radius), "m", Range{1e-5, 1e4}, "of the nozzle")),
        required_of("inflow", k("min", SHAPE_FIELD(InflowShape, min), "m", PLACE, "lowest corner of the rectangle, which is flat along one axis")),
        required_of("inflow", k("max", SHAPE_FIELD(InflowShape, max), "m", PLACE, "highest corner")),
        required_of("rain", k("min", SHAPE_FIELD(RainShape, min), "m", PLACE, "lowest corner of the box, which may be flat, that drops appear in")),
        required_of("rain", k("max", SHAPE_FIELD(RainShape, max), "m", PLACE, "highest corner")),
        required_of("rain", k("rate", SHAPE_FIELD(RainShape, rate), "kg/s", Range{1e-12, 1e9}, "how much falls, all in all")),
        liquid_key<EmitterBody>(FIELD(fluid), "what comes: gives rest_density, viscosity, surface_tension and color the values of a liquid, unless they stand in the scene; custom: nothing"),
        k("rest_density", FIELD(fluid.rest_density), "kg/m^3", Range{1e-3, 1e5}, "density without pressure"),
        k("viscosity", FIELD(fluid.viscosity), "Pa s", Range{0, 1e4}, "dynamic; auto: physics.viscosity"),
        k("surface_tension", FIELD(fluid.surface_tension), "N/m", Range{0, 1e4}, "as of a [[fluid]]"),
        k("velocity", FIELD(velocity), "m/s", SPEED, "that it comes with: through its rectangle, if it is an inflow"),
        k("start", FIELD(start), "s", Range{0, 1e6}, "when it begins"),
        k("stop", FIELD(stop), "s", Range{0, 1e6}, "when it ends; auto: with the run"),
        k("particles", FIELD(particles), "", Range{1, 1e9}, "that it has: it pauses while all of them are out, and takes those anew that went into sinks; auto: as many as come in the time of the run"),
        k("color", FIELD(fluid.color), "linear RGB", UNIT, "in render.color = \"material\""),
    }, thermal_keys<EmitterBody>(FIELD(fluid)));
}

std::vector<SinkKey> make_sink_keys()
{
    const auto k = [](auto... arguments) { return key<SinkBody>(arguments...); };
    return {
        shape_key<SinkBody>("where fluid and dust go out; each shape has keys of its own"),
        required_of("block", k("min", SHAPE_FIELD(BlockShape, min), "m", PLACE, "lowest corner")),
        required_of("block", k("max", SHAPE_FIELD(BlockShape, max), "m", PLACE, "highest corner")),
        required_of("sphere", k("center", SHAPE_FIELD(SphereShape, center), "m", PLACE, "center")),
        required_of("sphere", k("radius", SHAPE_FIELD(SphereShape, radius), "m", Range{1e-5, 1e4}, "radius")),
    };
}

std::vector<ColliderKey> make_collider_keys()
{
    const auto k = [](auto... arguments) { return key<ColliderBody>(arguments...); };
    return with_shape_keys<ColliderBody>("what it is; each shape has keys of its own", {
        k("spacing", FIELD(spacing), "particle spacings", Range{0.25, 0.75}, "distance of the boundary particles on its surface; from 0.8 on fluid would leak through"),
        flag<ColliderBody>("solid", FIELD(solid), "fluid that would start inside is left out; false: a hollow shell, which may hold fluid"),
        k("friction", FIELD(friction), "Pa s", Range{0, 1e4}, "viscosity of fluid against it; 0 lets it slip freely"),
        k("contact_angle", FIELD(contact_angle), "degrees", Range{0, 180}, "of fluid with surface tension at it, inside the fluid: below 90 fluid wets it (adhesion), above it beads off"),
        k("temperature", FIELD(temperature), "C", Range{-273.15, 1e5}, "that it keeps whatever heat flows through it; auto: it insulates"),
        k("conductivity", FIELD(conductivity), "W/(m K)", Range{1e-6, 1e6}, "of heat, where it has a temperature"),
        k("color", FIELD(color), "linear RGB", UNIT, "in render.color = \"material\"; gray in the other modes"),
    });
}

std::vector<SurfaceKey> make_surface_keys()
{
    const auto k = [](auto... arguments) { return key<SurfaceBody>(arguments...); };
    return with_shape_keys<SurfaceBody>("what it is; each shape has keys of its own", {
        k("count", FIELD(count), "", Range{1, 16777216}, "of splats"),
        choice<SurfaceBody>("method", FIELD(method), {{"random", SplatMethod::Random}, {"stratified", SplatMethod::Stratified}, {"blue-noise", SplatMethod::BlueNoise}},
                            "how they are spread: independently at random; one in each of as many patches of equal area; or so that no two are close together"),
        k("splat_radius", FIELD(splat_radius), "spacings", Range{0.01, 10}, "of a splat, a flat disc; a spacing is the square root of area / count; 1 closes a surface of blue noise, 2 one of random points"),
        k("color", FIELD(color), "linear RGB", UNIT, "of all its splats"),
    });
}

#undef SHAPE_FIELD
#undef ITSELF
#undef FIELD
// clang-format on

} // namespace

std::span<const SceneKey> scene_keys()
{
    static const std::vector<SceneKey> keys = make_scene_keys();
    return keys;
}

std::span<const FluidKey> fluid_keys()
{
    static const std::vector<FluidKey> keys = make_fluid_keys();
    return keys;
}

std::span<const SolidKey> solid_keys()
{
    static const std::vector<SolidKey> keys = make_solid_keys();
    return keys;
}

std::span<const EmitterKey> emitter_keys()
{
    static const std::vector<EmitterKey> keys = make_emitter_keys();
    return keys;
}

std::span<const SinkKey> sink_keys()
{
    static const std::vector<SinkKey> keys = make_sink_keys();
    return keys;
}

std::span<const ColliderKey> collider_keys()
{
    static const std::vector<ColliderKey> keys = make_collider_keys();
    return keys;
}

std::span<const SurfaceKey> surface_keys()
{
    static const std::vector<SurfaceKey> keys = make_surface_keys();
    return keys;
}

} // namespace meltpoint
