#pragma once

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

namespace meltpoint {

/// Plain data: all that a run needs. SI units, angles in degrees. Keys, units, defaults and ranges of the TOML form are
/// in scene_file.cpp's key table, from which apps/scenes/README.md is generated. std::nullopt means "auto".

enum class SphKernel { Paper, Wendland };
enum class StateEquation { Linear, Tait };
enum class Solver { Wcsph, Dfsph, Pbf };
enum class ViscosityModel { Auto, Explicit, Implicit };
enum class TensionModel { Si, Paper };

/// The box that the particles stay in.
struct DomainSettings {
    glm::vec3 min{-1.0f, 0.0f, -1.0f}; ///< m
    glm::vec3 max{1.0f, 2.0f, 1.0f};   ///< m
    std::uint32_t dimensions = 3;      ///< 2: everything lies in the plane z = 0, where z of places means nothing
    bool walls = true;                 ///< all faces are walls; without, leaving the domain ends the run
    glm::bvec3 periodic{false};        ///< axes that begin again where they end, instead of walls
    float wall_viscosity = 0.0f;       ///< Pa s; 0 is free slip
    float contact_angle = 90.0f;       ///< degrees, of fluid with tension at the walls
    glm::vec3 lid_velocity{0.0f};      ///< m/s, of the wall at max.y; along it
};

/// How finely fluid is divided.
struct ParticleSettings {
    float spacing = 0.02f;      ///< d, m
    float support_ratio = 2.0f; ///< H/d
};

/// What moves the fluid.
struct FluidPhysics {
    glm::vec3 gravity{0.0f, -9.81f, 0.0f}; ///< m/s^2
    float viscosity = 0.5f;                ///< dynamic, Pa s, of fluids that have none of their own
    ViscosityModel viscosity_model = ViscosityModel::Auto;
    std::optional<float> xsph;          ///< part of the differences that a step takes away; auto: 0.01 of pbf, else 0
    float vorticity_confinement = 0.0f; ///< epsilon of Macklin & Mueller 2013, m/s
    float shifting = 0.0f;              ///< diffusion coefficient in H/2 times the speed expected of the scene
    TensionModel tension_model = TensionModel::Si;
    float surface_tension = 0.0f;   ///< N/m, of fluids that have none of their own
    float tension_threshold = 0.5f; ///< on |n| H, of the paper's model
    StateEquation state_equation = StateEquation::Tait;
    std::optional<float> speed_of_sound; ///< m/s; auto: 10 times the speed expected of this scene
    float gamma = 7.0f;                  ///< Tait exponent
    float background_pressure = 0.0f;    ///< Pa
    bool clamp_pressure = true;
};

/// When the solves for pressure and for viscosity end.
struct SolveSettings {
    std::optional<float> density_error;      ///< mean of max(rho/rho0 - 1, 0); auto: 5e-4, of pbf 0.01
    float divergence_error = 1e-3f;          ///< mean of max(dt drho/dt / rho0, 0), a step
    std::uint32_t max_iterations = 60;       ///< of each solve of a step for pressure
    float viscosity_error = 0.01f;           ///< of the viscous forces, root mean square
    std::uint32_t viscosity_iterations = 60; ///< of a step's solve for viscosity, at most
};

/// Position based fluids (Macklin & Mueller 2013).
struct PbfSettings {
    std::uint32_t substeps = 2;              ///< a frame, at least
    std::optional<std::uint32_t> iterations; ///< Jacobi iterations a step; auto: until solve.density_error is met
    float relaxation = 0.01f;                ///< eps, in parts of the response of a full neighborhood
    float artificial_pressure = 0.01f;       ///< k, as a relative error of density
    float speed_cap = 0.5f;                  ///< spacings a step
};

/// How long a run is, and in what steps.
struct TimeSettings {
    std::optional<float> dt;   ///< s; auto: the largest step within the bounds of stability
    float frame_rate = 60.0f;  ///< frames per simulated second
    std::uint32_t frames = 90; ///< number of frames, frame 0 (the initial state) included
};

/// An axis-aligned box.
struct BlockShape {
    glm::vec3 min{0.0f}; ///< m
    glm::vec3 max{0.0f}; ///< m
};

/// A ball.
struct SphereShape {
    glm::vec3 center{0.0f}; ///< m
    float radius = 0.0f;    ///< m
};

/// The inside of a mesh.
struct MeshShape {
    std::string mesh;          ///< a path, resolved by the scene reader, or "builtin:teapot" and the like
    std::optional<float> size; ///< m, largest extent after scaling; auto: the mesh's own units are meters
    glm::vec3 position{0.0f};  ///< m, where the center of the mesh's bounding box goes
    glm::vec3 rotation{0.0f};  ///< degrees about x, then y, then z, about the center
};

using BodyShape = std::variant<BlockShape, SphereShape, MeshShape>;

enum class BodyLattice { Cubic, BlueNoise };

/// What a substance has to do with heat, fluid and solid.
struct ThermalProperties {
    float melting_point = 0.0f;          ///< degrees C
    float latent_heat = 334e3f;          ///< J/kg
    float specific_heat = 4186.0f;       ///< J/(kg K), of the fluid
    float solid_specific_heat = 2100.0f; ///< J/(kg K)
    float conductivity = 0.6f;           ///< W/(m K), of the fluid
    float solid_conductivity = 2.2f;     ///< W/(m K)

    bool operator==(const ThermalProperties&) const = default;
};

/// A shape filled with fluid.
struct FluidBody {
    BodyShape shape;
    std::string liquid = "custom";            ///< what its values were taken from (scene/liquids.h), or "custom"
    BodyLattice lattice = BodyLattice::Cubic; ///< how its particles lie at the start
    float rest_density = 1000.0f;             ///< kg/m^3
    std::optional<float> viscosity;           ///< dynamic, Pa s; auto: the scene's
    std::optional<float> surface_tension;     ///< N/m; auto: the liquid's, or the scene's (scene/materials.h)
    glm::vec3 velocity{0.0f};                 ///< m/s
    glm::mat3 velocity_gradient{
        0.0f};            ///< 1/s: adds gradient * position (a column-major glm matrix: gradient[column][row])
    glm::vec3 spin{0.0f}; ///< rad/s: adds spin x (position - spin_center)
    std::optional<glm::vec3> spin_center; ///< m; auto: the body's center
    std::optional<float> temperature;     ///< degrees C; auto: the air's, or the melting point if that is nearer
    ThermalProperties thermal;
    glm::vec3 color{0.16f, 0.45f, 0.78f}; ///< linear RGB of the material color mode
};

/// A front that runs through a solid and turns it into fluid, along a direction or from a point. It reaches a particle
/// at start + (depth + roughness noise) / speed, depth being the way from where it enters the solid.
struct DissolveFront {
    float speed = 0.0f;                 ///< m/s; 0: there is none
    float start = 0.0f;                 ///< s
    std::optional<glm::vec3> direction; ///< of any length but 0; auto: downward
    std::optional<glm::vec3> point;     ///< m, where it spreads from; auto: it runs along the direction
    float roughness = 0.0f;             ///< m, how far its noise puts it forward or back
    float grain = 0.1f;                 ///< m, size of the coarsest unevenness
};

/// m, of a solid of sand that does not say how large its grains are.
constexpr float usual_sand_grain = 250e-6f;

/// What a solid of sand consists of, apart from the size of its grains.
struct SandProperties {
    float grain_density = 2650.0f; ///< kg/m^3, of the mineral
    float cohesion = 3e-4f;        ///< N/m, gamma of Shao & Lu 2000
    float repose_angle = 34.0f;    ///< degrees

    bool operator==(const SandProperties&) const = default;
};

enum class SolidBecomes { Fluid, Dust };

/// What holds a solid in its place: the walls and colliders that it touches, all of itself, or nothing.
enum class SolidAnchor { Ground, All, None };

/// What makes parts of a solid stronger than others.
enum class StrengthSource { Noise, Color };

/// How flow carries a solid off (shared/hydraulic.h), and where the solid is stronger or weaker.
struct Erodibility {
    bool erodes = false;
    float threshold = 1.0f;          ///< tau_c, Pa, where there is no grain size
    std::optional<float> grain_size; ///< m: in flow the threshold is that of Shields; of sand
    float rate = 10.0f;              ///< K_eps, kg/(m^2 s Pa^exponent)
    float exponent = 1.0f;           ///< a
    bool deposits = true;            ///< its sediment becomes solid again
    float strength_contrast = 1.0f; ///< the strongest is so many times as strong as usual, and the weakest a part of it
    StrengthSource strength_from = StrengthSource::Noise;
    float strength_grain = 0.1f;              ///< m, size of the coarsest lumps, or layers
    std::optional<glm::vec3> strength_layers; ///< across layers, of any length but 0; auto: lumps

    bool operator==(const Erodibility&) const = default;
};

/// A solid that stands still while something holds it, and may turn into fluid, or crumble into dust. What FluidBody
/// says is of that fluid; its velocities are not used.
struct SolidBody : FluidBody {
    std::optional<float> solid_density;         ///< kg/m^3, while it is solid; auto: rest_density
    float friction = 0.0f;                      ///< of fluid against it, Pa s; 0 is free slip
    float contact_angle = 90.0f;                ///< degrees, of fluid with tension at it
    glm::vec3 solid_color{0.72f, 0.55f, 0.38f}; ///< linear RGB, while it is solid
    SolidBecomes becomes = SolidBecomes::Fluid;
    DissolveFront dissolve;
    bool melts = false;        ///< where heat has brought it to the end of its melting point
    float absorptivity = 0.7f; ///< part of the sun's power that it takes in
    bool wind_erodes = false;  ///< sand: the wind takes it, and it slides where it is too steep
    SandProperties sand;
    Erodibility erosion;
    SolidAnchor anchor = SolidAnchor::Ground;
    float sliding_friction = 0.5f; ///< mu, Coulomb's, of what breaks off it on anything
};

/// A round nozzle; it points along the emitter's velocity.
struct JetShape {
    glm::vec3 center{0.0f}; ///< m
    float radius = 0.0f;    ///< m
};

/// A rectangle, flat along one axis, that fluid comes through in full.
struct InflowShape {
    glm::vec3 min{0.0f}; ///< m
    glm::vec3 max{0.0f}; ///< m
};

/// A box, or a rectangle, at random places of which drops appear, a particle each.
struct RainShape {
    glm::vec3 min{0.0f}; ///< m
    glm::vec3 max{0.0f}; ///< m
    float rate = 0.0f;   ///< kg/s, of all of it
};

using EmitterShape = std::variant<JetShape, InflowShape, RainShape>;

/// Where fluid comes into a scene that runs.
struct EmitterBody {
    EmitterShape shape;
    FluidBody fluid;                        ///< what comes; its shape, lattice and velocities are not used
    glm::vec3 velocity{0.0f};               ///< m/s, that it comes with
    float start = 0.0f;                     ///< s
    std::optional<float> stop;              ///< s; auto: it never ends
    std::optional<std::uint32_t> particles; ///< that it has; auto: as many as come in the time of the run
};

using SinkShape = std::variant<BlockShape, SphereShape>;

/// Where fluid and dust go out of a scene that runs.
struct SinkBody {
    SinkShape shape;
};

/// Where heat comes from, and how fast it works.
struct HeatSettings {
    float time_scale = 1.0f;                       ///< seconds of heat in one of motion
    float sun = 1000.0f;                           ///< W/m^2 on a surface that faces it
    glm::vec3 sun_direction{-0.4f, -1.0f, -0.35f}; ///< that its light travels in, of any length but 0
    float air_temperature = 20.0f;                 ///< degrees C
    float air_transfer = 10.0f;                    ///< W/(m^2 K), from air to surfaces
};

/// The wind that blows over sand, and what it takes along.
struct WindSettings {
    glm::vec3 direction{1.0f, 0.0f, 0.0f}; ///< that it blows in, of any length but 0; level
    float friction_velocity = 0.0f;        ///< u*, m/s; 0: there is none
    float roughness_length = 1e-3f;        ///< z0, m
    float air_density = 1.2f;              ///< kg/m^3
    float flux = 1.8f;                     ///< C of Bagnold 1941
    float hop_length = 0.3f;               ///< m
    float time_scale = 1.0f;               ///< seconds of erosion in one of motion
};

/// The flow that erodes, and how its sediment settles (shared/hydraulic.h).
struct HydraulicSettings {
    float consistency = 1.0f;       ///< K, Pa s^exponent
    float exponent = 0.5f;          ///< n
    float time_scale = 1.0f;        ///< seconds of erosion in one of motion
    float deposition_speed = 0.05f; ///< m/s
    float deposition_time = 0.2f;   ///< s
};

/// The air that dust drifts with, and how it does.
struct DustSettings {
    glm::vec3 wind{0.4f, 0.25f, 0.0f}; ///< m/s
    float turbulence = 0.4f;           ///< m/s, root mean square of the eddies' velocity
    float eddy_size = 0.6f;            ///< m, wavelength of the largest
    float response_time = 0.15f;       ///< s, in which dust takes on the air's velocity
    float life = 2.0f;                 ///< s, in which it shrinks to nothing
};

/// A solid that does not move. Fluid meets boundary particles on its surface (Akinci et al. 2012).
struct ColliderBody {
    BodyShape shape;
    float spacing = 0.7f;                 ///< of its boundary particles, in particle spacings
    bool solid = true;                    ///< no fluid starts inside; false: a hollow shell
    float friction = 0.0f;                ///< of fluid against it, Pa s; 0 is free slip
    float contact_angle = 90.0f;          ///< degrees, of fluid with tension at it
    std::optional<float> temperature;     ///< degrees C, that it keeps; auto: it insulates
    float conductivity = 50.0f;           ///< W/(m K), where it has a temperature
    glm::vec3 color{0.55f, 0.50f, 0.44f}; ///< linear RGB
};

enum class SplatMethod { Random, Stratified, BlueNoise };

/// A surface shown as splats: drawn, not simulated.
struct SurfaceBody {
    BodyShape shape;
    std::uint32_t count = 20'000;                ///< of its splats
    SplatMethod method = SplatMethod::BlueNoise; ///< how they are spread
    float splat_radius = 1.0f;                   ///< in spacings, each sqrt(area / count)
    glm::vec3 color{0.72f, 0.55f, 0.38f};        ///< linear RGB
};

enum class Projection { Auto, Perspective, Orthographic };

/// From where a frame is seen.
struct CameraSettings {
    Projection projection = Projection::Auto; ///< auto: perspective, in two dimensions orthographic
    std::optional<glm::vec3> eye;             ///< m; auto: frames the domain
    std::optional<glm::vec3> target; ///< m; auto: center of the domain's lower half; in two dimensions its center
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float field_of_view = 40.0f;      ///< degrees, vertical
    std::optional<float> view_height; ///< m, of the orthographic view; auto: the domain's
};

enum class ColorMode { Material, Density, Speed, Pressure };

/// How a frame is drawn.
struct RenderSettings {
    std::uint32_t width = 960;  ///< pixels
    std::uint32_t height = 540; ///< pixels
    ColorMode color = ColorMode::Material;
    bool legend = true;                   ///< drawn in every mode but material
    std::optional<glm::vec2> color_range; ///< in the mode's unit; auto: a fixed range derived from the scene
    bool floor = true;                    ///< a ground plane at the domain's lowest face
    float splat_radius = 0.6f;            ///< of a fluid sphere, in particle spacings
    float blend_time = 0.4f;              ///< s, in which what was solid takes on the color of its fluid
    glm::vec3 light{0.45f, 1.0f, 0.35f};  ///< from the scene to the light, of any length but 0
    glm::vec3 background{0.93f, 0.95f, 0.97f};
};

/// All that a run needs.
struct Scene {
    std::string name = "untitled";
    std::string description;
    Solver solver = Solver::Wcsph;
    SphKernel kernel = SphKernel::Wendland;
    std::uint64_t seed = 1;
    DomainSettings domain;
    ParticleSettings particles;
    FluidPhysics physics;
    SolveSettings solve;
    PbfSettings pbf;
    DustSettings dust;
    HeatSettings heat;
    WindSettings wind;
    HydraulicSettings hydraulic;
    TimeSettings time;
    std::vector<FluidBody> fluids;
    std::vector<SolidBody> solids;
    std::vector<EmitterBody> emitters;
    std::vector<SinkBody> sinks;
    std::vector<ColliderBody> colliders;
    std::vector<SurfaceBody> surfaces;
    CameraSettings camera;
    RenderSettings render;
};

/// The volume of a solid over that of the fluid that it turns into.
[[nodiscard]] inline double volume_as_solid(const SolidBody& body)
{
    return static_cast<double>(body.rest_density) / static_cast<double>(body.solid_density.value_or(body.rest_density));
}

/// What holds a solid. Sand holds itself: it is no piece that breaks off, but falls grain by grain.
[[nodiscard]] inline SolidAnchor anchor_of(const SolidBody& body)
{
    return body.wind_erodes ? SolidAnchor::All : body.anchor;
}

/// Whether pieces of solids may break off and move.
[[nodiscard]] inline bool has_fragments(const Scene& scene)
{
    return std::ranges::any_of(scene.solids, [](const SolidBody& body) { return anchor_of(body) != SolidAnchor::All; });
}

/// Whether heat is followed: something melts, or has a temperature of its own.
[[nodiscard]] inline bool has_heat(const Scene& scene)
{
    const auto has_temperature = [](const auto& body) {
        return body.temperature.has_value();
    };
    return std::ranges::any_of(scene.solids, &SolidBody::melts) || std::ranges::any_of(scene.solids, has_temperature) ||
           std::ranges::any_of(scene.fluids, has_temperature) ||
           std::ranges::any_of(scene.colliders, has_temperature) ||
           std::ranges::any_of(scene.emitters,
                               [&](const EmitterBody& emitter) { return has_temperature(emitter.fluid); });
}

/// Whether there is sand.
[[nodiscard]] inline bool has_sand(const Scene& scene)
{
    return std::ranges::any_of(scene.solids, &SolidBody::wind_erodes);
}

/// Whether flow erodes anything.
[[nodiscard]] inline bool has_hydraulic(const Scene& scene)
{
    return std::ranges::any_of(scene.solids, [](const SolidBody& solid) { return solid.erosion.erodes; });
}

/// The fluid that grains lie in: the scene's first, or the first that emitters bring. Null where there is none.
[[nodiscard]] inline const FluidBody* eroding_fluid(const Scene& scene)
{
    if (!scene.fluids.empty()) {
        return &scene.fluids.front();
    }
    return scene.emitters.empty() ? nullptr : &scene.emitters.front().fluid;
}

/// All bodies that are fluid or may turn into it: the fluids, then the solids, then what emitters bring.
[[nodiscard]] inline std::vector<const FluidBody*> fluid_bodies(const Scene& scene)
{
    std::vector<const FluidBody*> bodies;
    for (const FluidBody& body : scene.fluids) {
        bodies.push_back(&body);
    }
    for (const SolidBody& body : scene.solids) {
        bodies.push_back(&body);
    }
    for (const EmitterBody& emitter : scene.emitters) {
        bodies.push_back(&emitter.fluid);
    }
    return bodies;
}

} // namespace meltpoint
