#include "run/fluid_settings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "core/aabb.h"
#include "core/error.h"
#include "particles/sph_kernel.h"
#include "run/dust_params.h"
#include "run/emission_settings.h"
#include "run/fragment_settings.h"
#include "run/heat_settings.h"
#include "run/hydraulic_settings.h"
#include "run/plane_scene.h"
#include "run/scene_warnings.h"
#include "run/wind_settings.h"
#include "scene/materials.h"
#include "scene/scene_check.h"

namespace meltpoint {

namespace {

// s: however slow the fluid is. In steps of 5 ms the density of water half a meter high is off by 0.1 % in the mean.
constexpr double longest_solved_step = 4.5e-3;
constexpr double sound_per_speed = 10.0; // density error about 1 %

std::uint32_t solver_number(Solver solver)
{
    switch (solver) {
    case Solver::Dfsph:
        return shared::SOLVER_DFSPH;
    case Solver::Pbf:
        return shared::SOLVER_PBF;
    case Solver::Wcsph:
        break;
    }
    return shared::SOLVER_WCSPH;
}

double support_radius(const Scene& scene)
{
    return static_cast<double>(scene.particles.spacing) * static_cast<double>(scene.particles.support_ratio);
}

/// Pa s, of the fluid, at the walls or at a collider.
double largest_viscosity(const Scene& scene)
{
    const float at_walls = scene.domain.walls ? scene.domain.wall_viscosity : 0.0f;
    float largest = at_walls;
    for (const FluidBody* fluid : fluid_bodies(scene)) {
        largest = std::max(largest, fluid->viscosity.value_or(scene.physics.viscosity));
    }
    for (const SolidBody& solid : scene.solids) {
        largest = std::max(largest, solid.friction);
    }
    for (const ColliderBody& collider : scene.colliders) {
        largest = std::max(largest, collider.friction);
    }
    return static_cast<double>(largest);
}

/// Pa s, of the thinnest fluid.
double least_viscosity(const Scene& scene)
{
    float least = std::numeric_limits<float>::infinity();
    for (const FluidBody* fluid : fluid_bodies(scene)) {
        least = std::min(least, fluid->viscosity.value_or(scene.physics.viscosity));
    }
    return static_cast<double>(least);
}

/// s, of a time step: what ripples a spacing long need (after Brackbill, Kothe & Zemach 1992, equation 61).
double tension_bound(const Scene& scene)
{
    double bound = std::numeric_limits<double>::infinity();
    for (const FluidBody* fluid : fluid_bodies(scene)) {
        const double sigma = static_cast<double>(tension_of(scene, *fluid));
        const double mass =
            static_cast<double>(fluid->rest_density) * std::pow(static_cast<double>(scene.particles.spacing), 3.0);
        bound = sigma > 0.0 ? std::min(bound, 0.2 * std::sqrt(mass / sigma)) : bound;
    }
    return bound;
}

bool differ_in_viscosity(const Scene& scene)
{
    const std::vector<const FluidBody*> bodies = fluid_bodies(scene);
    return std::ranges::any_of(bodies, [&](const FluidBody* fluid) {
        const float first = bodies.front()->viscosity.value_or(scene.physics.viscosity);
        return fluid->viscosity.value_or(scene.physics.viscosity) != first;
    });
}

/// How far x can fall along gravity before it meets the domain's border, times |g|.
double fall_work(const Scene& scene, const glm::dvec3& x)
{
    const glm::dvec3 g(scene.physics.gravity);
    double work = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (scene.domain.periodic[axis]) {
            continue; // there is no end to it
        }
        const double end = static_cast<double>(g[axis] < 0.0 ? scene.domain.min[axis] : scene.domain.max[axis]);
        work += std::max(g[axis] * (end - x[axis]), 0.0);
    }
    return work;
}

double heaviest_rest_density(const Scene& scene)
{
    double heaviest = 0.0;
    for (const FluidBody* body : fluid_bodies(scene)) {
        heaviest = std::max(heaviest, static_cast<double>(body->rest_density));
    }
    return heaviest;
}

float cosine_of(float degrees)
{
    return static_cast<float>(std::cos(static_cast<double>(degrees) * std::numbers::pi / 180.0));
}

/// The fastest that a step's longest move allows is reserve for a fluid that accelerates.
constexpr float share_of_speed_cap = 0.8f;

void set_pbf(const Scene& scene, shared::SphParams& params)
{
    if (scene.pbf.iterations) {
        params.least_iterations = params.max_iterations = *scene.pbf.iterations;
        params.density_error = std::numeric_limits<float>::max(); // whatever it is
    }
    params.artificial_pressure = scene.pbf.artificial_pressure;
    params.speed_cap = scene.pbf.speed_cap * scene.particles.spacing;
}

/// The farthest that a particle moves in a step that the device chooses, where pressure is solved for, m.
float cfl_length(const Scene& scene)
{
    return (scene.solver == Solver::Pbf ? share_of_speed_cap * scene.pbf.speed_cap : 0.4f) * scene.particles.spacing;
}

/// s, of a step where pressure is solved for.
double longest_step(const Scene& scene)
{
    const double frame = 1.0 / static_cast<double>(scene.time.frame_rate);
    return scene.solver == Solver::Pbf ? frame / scene.pbf.substeps : std::min(longest_solved_step, frame);
}

/// The axis that gravity is most along.
int down_axis(const Scene& scene)
{
    const glm::vec3 pull = glm::abs(scene.physics.gravity);
    return pull.x >= std::max(pull.y, pull.z) ? 0 : (pull.y >= pull.z ? 1 : 2);
}

/// m^2, of a box seen along gravity; in two dimensions m.
double area_below(const Scene& scene, const glm::dvec3& size)
{
    double area = 1.0;
    for (int axis = 0; axis < static_cast<int>(scene.domain.dimensions); ++axis) {
        area *= axis == down_axis(scene) ? 1.0 : size[axis];
    }
    return area;
}

/// m, of a scene's fluid once it has settled, with all that may become fluid; and of as much fluid as weighs what the
/// heaviest loose body does on what lies below it. 0 where nothing holds the fluid together.
double settled_depth(const Scene& scene, const shared::SphParams& params, const ParticleSet& particles)
{
    if (!scene.domain.walls || scene.domain.periodic[down_axis(scene)] || eroding_fluid(scene) == nullptr) {
        return 0.0;
    }
    struct Sum {
        double mass = 0.0;
        Aabb box;
    };
    std::vector<Sum> of(shared::MAX_MATERIALS);
    double volume = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const std::uint32_t material = shared::particle_material(particles.attributes[i]);
        const float density = params.rest_density[material];
        volume += density > 0.0f ? static_cast<double>(particles.mass[i]) / static_cast<double>(density) : 0.0;
        of[material].mass += static_cast<double>(particles.mass[i]);
        of[material].box.extend(particles.position[i]);
    }
    double load = 0.0; // kg/m^2
    const SceneMaterials materials = scene_materials(scene);
    for (std::size_t s = 0; s < scene.solids.size(); ++s) {
        const Sum& its = of[materials.of_solid[s]];
        const glm::dvec3 size = glm::dvec3(its.box.size()) + static_cast<double>(scene.particles.spacing);
        load = scene.solids[s].anchor == SolidAnchor::None && its.mass > 0.0
                   ? std::max(load, its.mass / area_below(scene, size))
                   : load;
    }
    const double depth = volume / area_below(scene, scene.domain.max - scene.domain.min);
    return depth + load / static_cast<double>(eroding_fluid(scene)->rest_density);
}

/// s, of a step of dfsph: fluid under the pressure p buckles in longer ones than about 0.65 d sqrt(rho / p), as
/// measured on water at rest that is 40 particles deep; at its bottom p is rho g depth.
double pressure_bound(const Scene& scene, const shared::SphParams& params, const ParticleSet& particles)
{
    const double pull = static_cast<double>(glm::length(scene.physics.gravity));
    const double waves = std::sqrt(pull * settled_depth(scene, params, particles)); // m/s
    return scene.solver == Solver::Dfsph && waves > 0.0 ? 0.5 * static_cast<double>(scene.particles.spacing) / waves
                                                        : std::numeric_limits<double>::infinity();
}

/// The borders of the axes of a scene of which periodic is so: two bits an axis.
std::uint32_t border_mask(const Scene& scene, bool periodic)
{
    std::uint32_t mask = 0;
    for (std::uint32_t axis = 0; axis < scene.domain.dimensions; ++axis) {
        mask |= scene.domain.periodic[static_cast<int>(axis)] == periodic ? 3u << 2 * axis : 0u;
    }
    return mask;
}

void check_width(const Scene& scene)
{
    if (const std::optional<NarrowAxis> narrow = find_narrow_axis(scene)) {
        throw input_error("{}: the domain {}", scene.name, narrow->complaint);
    }
}

/// The device counts steps in 32 bits, of which one value means "none".
void check_step_count(const Scene& scene, double dt)
{
    constexpr double most_steps = 4294967294.0;
    const double duration = (scene.time.frames - 1) / static_cast<double>(scene.time.frame_rate);
    if (!(duration / dt <= most_steps)) {
        throw input_error(
            "{}: {} frames at a dt of {:.4g} s are {:.3g} steps, more than {:.0f}: choose fewer frames or a "
            "larger time.dt",
            scene.name, scene.time.frames, dt, duration / dt, most_steps);
    }
}

} // namespace

double expected_speed(const Scene& scene, const ParticleSet& particles)
{
    double fastest = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (shared::particle_state(particles.attributes[i]) == shared::STATE_COLLIDER) {
            continue; // solids may turn into fluid
        }
        const double start = glm::length(glm::dvec3(particles.velocity[i]));
        const double fall = std::sqrt(2.0 * fall_work(scene, glm::dvec3(particles.position[i])));
        fastest = std::max(fastest, start + fall);
    }
    if (particles.size() > 0) {
        fastest = std::max(fastest, static_cast<double>(glm::length(scene.domain.lid_velocity)));
    }
    constexpr double nothing_known = 1.0;
    return fastest > 0.0 ? fastest : nothing_known;
}

TimeStepBounds time_step_bounds(const Scene& scene, double speed_of_sound, double speed)
{
    const double support = support_radius(scene);
    double lightest = std::numeric_limits<double>::infinity();
    for (const FluidBody* body : fluid_bodies(scene)) {
        lightest = std::min(lightest, static_cast<double>(body->rest_density));
    }
    const double viscosity = largest_viscosity(scene);
    const double cfl = scene.solver == Solver::Wcsph
                           ? 0.4 * 0.5 * support / (speed_of_sound + speed)
                           : std::min(static_cast<double>(cfl_length(scene)) / speed, longest_step(scene));
    return {.cfl = cfl,
            .viscosity = viscosity > 0.0 ? 0.06 * lightest * support * support / viscosity
                                         : std::numeric_limits<double>::infinity(),
            .tension = tension_bound(scene)};
}

bool solves_viscosity(const Scene& scene, const TimeStepBounds& bounds)
{
    if (scene.solver == Solver::Pbf) {
        if (scene.physics.viscosity_model == ViscosityModel::Implicit) {
            throw input_error(
                "{}: physics.viscosity_model is \"implicit\", which solver \"pbf\" has not: take dfsph or wcsph",
                scene.name);
        }
        return false;
    }
    if (scene.physics.viscosity_model != ViscosityModel::Auto) {
        return scene.physics.viscosity_model == ViscosityModel::Implicit;
    }
    const double frame = 1.0 / static_cast<double>(scene.time.frame_rate);
    return bounds.viscosity < (scene.time.dt ? static_cast<double>(*scene.time.dt) : std::min(bounds.cfl, frame));
}

sim::SimulationSettings with_fixed_steps(sim::SimulationSettings settings)
{
    settings.params.adaptive_dt = 0;
    return settings;
}

FluidSettings fluid_settings(const Scene& any_scene, const ParticleSet& particles)
{
    const Scene scene = in_its_dimensions(any_scene);
    check_width(scene);
    FluidSettings settings;
    shared::SphParams& params = settings.simulation.params;
    params.domain_min = scene.domain.min;
    params.domain_max = scene.domain.max;
    params.support_radius = static_cast<float>(support_radius(scene));
    params.gravity = scene.physics.gravity;
    params.wall_mask = scene.domain.walls ? border_mask(scene, false) : 0u;
    params.periodic_mask = border_mask(scene, true);
    params.lid_velocity = scene.domain.lid_velocity;
    params.state_equation = scene.physics.state_equation == StateEquation::Tait ? shared::STATE_EQUATION_TAIT
                                                                                : shared::STATE_EQUATION_LINEAR;
    params.clamp_pressure = scene.physics.clamp_pressure ? 1 : 0;
    const double speed = expected_speed(scene, particles);
    params.speed_of_sound = scene.physics.speed_of_sound.value_or(static_cast<float>(sound_per_speed * speed));
    params.gamma = scene.physics.gamma;
    params.background_pressure = scene.physics.background_pressure;
    params.wall_viscosity = scene.domain.wall_viscosity;
    params.xsph = scene.physics.xsph.value_or(scene.solver == Solver::Pbf ? 0.01f : 0.0f);
    params.vorticity_confinement = scene.physics.vorticity_confinement;
    params.shifting =
        scene.physics.shifting * static_cast<float>(0.5 * support_radius(scene) * speed); // a way of H/2 at that speed
    params.surface_tension = scene.physics.tension_model == TensionModel::Paper ? scene.physics.surface_tension : 0.0f;
    params.wall_contact_cosine = cosine_of(scene.domain.contact_angle);
    params.tension_threshold = scene.physics.tension_threshold;
    params.density_error = scene.solve.density_error.value_or(scene.solver == Solver::Pbf ? 0.01f : 5e-4f);
    params.divergence_error = scene.solve.divergence_error;
    params.max_iterations = scene.solve.max_iterations;
    params.viscosity_error = scene.solve.viscosity_error;
    params.viscosity_iterations = scene.solve.viscosity_iterations;
    params.least_iterations = 1;
    if (scene.solver == Solver::Pbf) {
        set_pbf(scene, params);
    }
    const SceneMaterials materials = scene_materials(scene);
    for (std::size_t i = 0; i < materials.materials.size(); ++i) {
        params.rest_density[i] = materials.materials[i].rest_density;
        params.viscosity[i] = materials.materials[i].viscosity;
        params.friction[i] = materials.materials[i].friction;
        params.tension[i] = materials.materials[i].tension;
        params.contact_cosine[i] = cosine_of(materials.materials[i].contact_angle);
        settings.simulation.options.capillarity |= materials.materials[i].tension > 0.0f;
    }

    const double frame_rate = static_cast<double>(scene.time.frame_rate);
    TimeStepBounds bounds = time_step_bounds(scene, static_cast<double>(params.speed_of_sound), speed);
    sim::FluidOptions& options = settings.simulation.options;
    options.implicit_viscosity = solves_viscosity(scene, bounds);
    if (options.implicit_viscosity) {
        bounds.viscosity = std::numeric_limits<double>::infinity();
    }
    params.adaptive_dt = scene.time.dt ? 0 : 1;
    params.dt = scene.time.dt.value_or(static_cast<float>(std::min(bounds.smallest(), 1.0 / frame_rate)));
    const bool solved = scene.solver != Solver::Wcsph;
    params.cfl_length = solved ? cfl_length(scene) : 0.4f * 0.5f * params.support_radius;
    if (scene.solver == Solver::Dfsph) {
        // Fluid too dense may part as fast as particles move anyway; steps of the usual length take all of it away, as
        // in Bender & Koschier 2017.
        const double usual_step = std::min(static_cast<double>(params.cfl_length) / speed, 0.5 * longest_solved_step);
        params.correction_time = static_cast<float>(usual_step);
    }
    params.cfl_speed = solved ? 0.0f : params.speed_of_sound;
    params.longest_dt =
        static_cast<float>(std::min({bounds.viscosity, bounds.tension, pressure_bound(scene, params, particles),
                                     1.0 / frame_rate, solved ? longest_step(scene) : 1.0 / frame_rate}));
    params.shortest_dt = 1e-3f * params.dt;
    const double dt = static_cast<double>(params.dt);
    if (dt * frame_rate > 1.0 + 1e-6) {
        throw input_error("{}: time.dt is {:.6g} s, longer than a frame of {:.6g} s (time.frame_rate {:.6g})",
                          scene.name, dt, 1.0 / frame_rate, frame_rate);
    }
    check_step_count(scene, dt);
    if (dt > bounds.cfl * (1.0 + 1e-6)) {
        settings.warnings.push_back(fmt::format(
            "time.dt is {:.4g} s, above the CFL bound of {:.4g} s ({}expected speed {:.4g} m/s, support radius "
            "{:.4g} m): the run may break down",
            dt, bounds.cfl, solved ? "" : fmt::format("speed of sound {:.4g} m/s, ", params.speed_of_sound), speed,
            params.support_radius));
    }
    if (dt > bounds.viscosity * (1.0 + 1e-6)) {
        settings.warnings.push_back(
            fmt::format("time.dt is {:.4g} s, above the viscous bound of {:.4g} s (viscosity {:.4g} "
                        "Pa s): the run may break down",
                        dt, bounds.viscosity, largest_viscosity(scene)));
    }
    // Spiky is not poly6's gradient: the paper's kernels feed in energy that only viscosity takes out again (measured:
    // energy falls from about 0.005 rho c0 d on).
    const double calming = 0.005 * heaviest_rest_density(scene) * static_cast<double>(params.speed_of_sound) *
                           static_cast<double>(scene.particles.spacing);
    if (scene.kernel == SphKernel::Paper && least_viscosity(scene) < calming) {
        settings.warnings.push_back(
            fmt::format("physics.viscosity is {:.4g} Pa s; below about {:.2g} Pa s the paper's kernels "
                        "feed energy into this scene (kernel = \"wendland\" does not)",
                        least_viscosity(scene), calming));
    }
    if (dt > bounds.tension * (1.0 + 1e-6)) {
        settings.warnings.push_back(
            fmt::format("time.dt is {:.4g} s, above the bound of surface tension of {:.4g} s: the run may break down",
                        dt, bounds.tension));
    }
    std::ranges::move(scene_warnings(scene, particles), std::back_inserter(settings.warnings));
    // The CFL bound of the particles' own speed; the sound's is for the warning above.
    params.longest_move = (solved ? 0.5f : 0.4f * 0.5f) * params.support_radius;
    if (scene.solver == Solver::Pbf) { // it has a speed cap, which leaves no one too fast
        params.longest_move = 2.0f * params.speed_cap;
    }
    params.speed_limit = params.longest_move / params.dt;

    options.solver = solver_number(scene.solver);
    options.kernel = scene.kernel == SphKernel::Wendland ? shared::KERNEL_WENDLAND : shared::KERNEL_PAPER;
    options.mixed_viscosity = differ_in_viscosity(scene);
    options.tension = params.surface_tension > 0.0f;
    if (std::ranges::any_of(scene.solids, [](const SolidBody& solid) { return solid.becomes == SolidBecomes::Dust; })) {
        settings.simulation.dust = dust_params(scene);
    }
    settings.simulation.emission = emission_settings(scene, particles);
    settings.simulation.melting = melting_settings(scene, particles);
    settings.simulation.wind = wind_settings(scene);
    settings.simulation.hydraulic = hydraulic_settings(scene, particles);
    settings.simulation.fragments = fragment_settings(scene);
    options.still = std::ranges::any_of(particles.attributes, shared::is_boundary);
    options.colliders = options.capillarity && options.still;
    options.xsph = params.xsph > 0.0f;
    options.confinement = params.vorticity_confinement > 0.0f;
    options.shifting = params.shifting > 0.0f;
    options.dimensions = scene.domain.dimensions;
    set_kernel_scales(params, options.kernel, static_cast<double>(scene.particles.spacing), options.dimensions);
    params.constraint_softness =
        static_cast<float>(static_cast<double>(scene.pbf.relaxation) *
                           lattice_response(options.kernel, support_radius(scene),
                                            static_cast<double>(scene.particles.spacing), options.dimensions));
    return settings;
}

} // namespace meltpoint
