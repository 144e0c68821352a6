#include "sim/wind.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "gpu/transfer.h"
#include "shared/pool_changes.h"
#include "spirv/sim/alight.comp.h"
#include "spirv/sim/column_top.comp.h"
#include "spirv/sim/ground.comp.h"
#include "spirv/sim/hop.comp.h"
#include "spirv/sim/land.comp.h"
#include "spirv/sim/slide.comp.h"
#include "spirv/sim/slide_apply.comp.h"
#include "spirv/sim/wind_erode.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;
using gpu::write;

namespace {

constexpr double air_viscosity = 1.8e-5;    // Pa s
constexpr double least_hop = 4.0;           // spacings
constexpr double fastest_launch = 1000.0;   // m/s
constexpr double first_slide_degrees = 1.0; // beyond the angle of repose
constexpr std::uint32_t nobody = 0xffffffffu;

/// m, that a grain gets over flat ground before it is down again.
double hop_length(double launch_speed, double response, const WindSettings& settings, double gravity)
{
    constexpr int steps = 2000;
    const double dt = 3.0 * launch_speed / gravity / steps; // longer than the flight: drag takes from its height
    double height = 0.0;
    double along = 0.0;
    double length = 0.0;
    double upward = launch_speed;
    for (int i = 0; i < steps && height >= 0.0; ++i) {
        const double air = settings.friction_velocity / static_cast<double>(shared::KARMAN) *
                           std::log(std::max(height / settings.roughness_length, 1.0));
        const double taken_on = -std::expm1(-dt / response);
        along += taken_on * (air - along);
        upward += taken_on * (-gravity * response - upward);
        height += dt * upward;
        length += dt * along;
    }
    return length;
}

/// m/s, upward, at which a hop is as long as it is to be.
double launch_speed(double response, const WindSettings& settings, double gravity)
{
    double low = 0.0;
    double high = fastest_launch;
    if (hop_length(high, response, settings, gravity) < settings.hop_length) {
        throw input_error("hops of {:.4g} m (wind.hop_length) are longer than a wind of a friction velocity of {:.4g} "
                          "m/s carries such "
                          "sand (grain_size, grain_density)",
                          settings.hop_length, settings.friction_velocity);
    }
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (hop_length(middle, response, settings, gravity) < settings.hop_length ? low : high) = middle;
    }
    return high;
}

double tangent(double degrees)
{
    return std::tan(degrees * std::numbers::pi / 180.0);
}

/// s, in which sand slides by a spacing: half of what it takes to fall as far from rest.
double spacing_time(const shared::SphParams& params)
{
    return 0.5 * std::sqrt(2.0 * static_cast<double>(params.spacing) / glm::length(glm::dvec3(params.gravity)));
}

/// s of motion, in which the wind at its strongest takes a layer of particles.
double shortest_erosion(const shared::WindParams& wind, const shared::SphParams& params, double time_scale)
{
    const double stress = static_cast<double>(shared::stress_on_slope(shared::STEEPEST_STRESS));
    double shortest = std::numeric_limits<double>::infinity();
    for (std::uint32_t material = 0; material < shared::MAX_MATERIALS; ++material) {
        const shared::WindMaterial& sand = wind.of[material];
        const double pick_up = static_cast<double>(sand.pick_up) * std::pow(stress, 1.5) * time_scale;
        if (sand.erodes != 0 && pick_up > 0.0 && stress > static_cast<double>(sand.threshold)) {
            shortest = std::min(shortest, static_cast<double>(params.rest_density[material]) *
                                              static_cast<double>(params.spacing) / pick_up);
        }
    }
    return shortest;
}

} // namespace

double threshold_friction_velocity(const Sand& sand, double air_density, double gravity)
{
    const double holding = sand.grain_density * gravity * sand.grain_size + sand.cohesion / sand.grain_size;
    return std::sqrt(0.0123 * holding / air_density);
}

double bagnold_flux(const WindSettings& settings, const Sand& sand, double gravity)
{
    constexpr double reference_size = 250e-6; // m
    if (settings.friction_velocity <= threshold_friction_velocity(sand, settings.air_density, gravity)) {
        return 0.0;
    }
    return settings.flux * std::sqrt(sand.grain_size / reference_size) * settings.air_density / gravity *
           std::pow(settings.friction_velocity, 3.0);
}

double response_time(const Sand& sand, double air_density, double gravity)
{
    const double stokes = sand.grain_density * sand.grain_size * sand.grain_size / (18.0 * air_viscosity);
    double response = stokes;
    for (int i = 0; i < 100; ++i) { // the mean of old and new: by itself it would swing
        const double reynolds = air_density * response * gravity * sand.grain_size / air_viscosity;
        response = 0.5 * (response + stokes / (1.0 + 0.15 * std::pow(reynolds, 0.687)));
    }
    return response;
}

shared::WindParams wind_params(const WindSettings& settings, const shared::SphParams& params)
{
    const glm::dvec3 gravity(params.gravity);
    const double g = glm::length(gravity);
    if (!(g > 0.0)) {
        throw input_error("sand needs gravity to come down, but there is none");
    }
    const glm::dvec3 up = -gravity / g;
    const glm::dvec3 level = glm::dvec3(settings.direction) - glm::dot(glm::dvec3(settings.direction), up) * up;
    if (!(glm::length(level) > 0.0)) {
        throw input_error("a wind along ({}, {}, {}) does not blow over ground", settings.direction.x,
                          settings.direction.y, settings.direction.z);
    }
    const double spacing = static_cast<double>(params.spacing);
    const bool blows = settings.friction_velocity > 0.0;
    if (blows && settings.hop_length < least_hop * spacing) {
        throw input_error("hops of {:.4g} m (wind.hop_length) are shorter than {} particle spacings of {:.4g} m",
                          settings.hop_length, least_hop, spacing);
    }
    const glm::dvec3 low(params.domain_min);
    const glm::dvec3 high(params.domain_max);
    shared::WindParams wind{};
    wind.direction = glm::normalize(level);
    wind.friction_velocity = static_cast<float>(settings.friction_velocity);
    wind.up = up;
    wind.roughness_length = static_cast<float>(settings.roughness_length);
    wind.floor_height = static_cast<float>(glm::dot(up, 0.5 * (low + high)) - 0.5 * glm::dot(glm::abs(up), high - low));
    for (std::uint32_t material = 0; material < shared::MAX_MATERIALS; ++material) {
        const Sand& sand = settings.sand[material];
        if (!sand.erodes) {
            continue;
        }
        shared::WindMaterial& its = wind.of[material];
        its.erodes = 1;
        its.steepest = static_cast<float>(tangent(sand.repose_angle + first_slide_degrees));
        its.response_time = static_cast<float>(response_time(sand, settings.air_density, g));
        if (blows) {
            const double threshold = threshold_friction_velocity(sand, settings.air_density, g);
            Sand without_threshold = sand; // slopes may bring the wind over it
            without_threshold.grain_density = without_threshold.cohesion = 0.0;
            its.pick_up = static_cast<float>(bagnold_flux(settings, without_threshold, g) / settings.hop_length);
            its.threshold = static_cast<float>(std::pow(threshold / settings.friction_velocity, 2.0));
            its.launch_speed = static_cast<float>(launch_speed(static_cast<double>(its.response_time), settings, g));
        }
    }
    return wind;
}

VisibilitySettings ground_view(const shared::WindParams& wind)
{
    return {.direction = -wind.up, .texel = 1.0f};
}

VisibilitySettings wind_view(const shared::WindParams& wind)
{
    return {.direction = wind.direction - shared::REATTACHMENT_SLOPE * wind.up};
}

Wind::Wind(const gpu::Context& context, const shared::SphParams& params, const WindSettings& settings)
    : params_(wind_params(settings, params)), time_scale_(settings.time_scale), spacing_(params.spacing),
      slide_time_(spacing_time(params)),
      longest_look_(std::min(0.1 * shortest_erosion(params_, params, settings.time_scale), slide_time_)),
      visibility_(context, wind_view(params_), params), from_above_(context, ground_view(params_), params),
      ground_kernel_(context, "ground", sim_ground_comp), column_top_(context, "column_top", sim_column_top_comp),
      erode_(context, "wind_erode", sim_wind_erode_comp), slide_(context, "slide", sim_slide_comp),
      alight_(context, "alight", sim_alight_comp), slide_apply_(context, "slide_apply", sim_slide_apply_comp),
      land_(context, "land", sim_land_comp, fluid_constants(context.info(), {})), hop_(context, "hop", sim_hop_comp),
      params_buffer_(gpu::make_buffer<shared::WindParams>(context, 1, "wind params")),
      ground_(gpu::make_buffer<glm::vec4>(context, from_above_.texels(), "ground")),
      top_id_(gpu::make_buffer<std::uint32_t>(context, from_above_.texels(), "column tops")),
      way_(gpu::make_buffer<std::uint32_t>(context, from_above_.texels(), "ways")),
      claim_(gpu::make_buffer<std::uint32_t>(context, from_above_.texels(), "claims")),
      damage_(gpu::make_buffer<glm::vec2>(context, params.pool_count, "damage")),
      rests_(gpu::make_buffer<std::uint32_t>(context, params.pool_count, "rests"))
{
    gpu::upload<shared::WindParams>(context, params_buffer_, {&params_, 1});
}

void Wind::record_start(gpu::Commands& commands) const
{
    commands.fill(damage_, 0);
    commands.fill(rests_, 0);
}

void Wind::record_surface(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                          const Exposure& exposure) const
{
    const gpu::Scope scope(commands, "sand surface");
    visibility_.record(commands, params, particles, exposure.exposure());
    from_above_.record(commands, params, particles, exposure.exposure());
    commands.dispatch(ground_kernel_, from_above_.texels(), gpu::NoPush{},
                      {read(params), read(from_above_.params()), read(from_above_.map()), write(ground_)});
    commands.fill(top_id_, nobody);
    commands.dispatch(column_top_, particles.count - particles.moving, gpu::NoPush{},
                      {read(params), read(params_buffer_), read(from_above_.params()), read(ground_),
                       read(particles.id), read(particles.attributes), read(particles.position),
                       read(from_above_.map()), read_write(top_id_)});
}

void Wind::record_changes(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                          const NeighborGrid& grid, const Exposure& exposure, const gpu::Buffer& changes,
                          double seconds, double next_seconds)
{
    const gpu::Scope scope(commands, "wind");
    const std::uint32_t still = particles.count - particles.moving;
    commands.fill(way_, shared::WAY_NONE);
    commands.fill(claim_, nobody);
    const shared::WindPush push{.seconds = static_cast<float>(seconds * time_scale_),
                                .ahead = static_cast<float>(seconds > 0.0 ? 0.5 * next_seconds / seconds : 0.0)};
    commands.dispatch(erode_, still, push,
                      {read(params), read(params_buffer_), read(from_above_.params()), read(ground_),
                       read(particles.id), read(exposure.exposure()), read(visibility_.visibility()),
                       read_write(damage_), read_write(particles.attributes), read_write(particles.position),
                       read_write(particles.velocity), read_write(changes), read(top_id_), write(way_)});
    commands.dispatch(alight_, particles.moving, gpu::NoPush{},
                      {read(params), read(params_buffer_), read(from_above_.params()), read(ground_),
                       read(particles.id), read(particles.attributes), read_write(particles.position),
                       read_write(rests_), read_write(claim_)});
    slid_for_ += seconds;
    if (slid_for_ >= slide_time_) {
        slid_for_ = 0.0;
        commands.dispatch(slide_, still, gpu::NoPush{},
                          {read(params), read(params_buffer_), read(from_above_.params()), read(ground_),
                           read(particles.id), read(particles.attributes), read(particles.position), read(top_id_),
                           write(way_), read_write(claim_)});
        commands.dispatch(slide_apply_, still, gpu::NoPush{},
                          {read(params), read(params_buffer_), read(from_above_.params()), read(ground_),
                           read(particles.id), read(top_id_), read(way_), read(claim_),
                           read_write(particles.attributes), read_write(particles.position), read_write(changes)});
    }
    commands.dispatch(land_, particles.moving, gpu::NoPush{},
                      {read(params), read(params_buffer_), read(from_above_.params()), read(ground_),
                       read(particles.id), read(top_id_), read(way_), read(claim_), read_write(rests_),
                       read_write(particles.attributes), read_write(particles.position), read_write(particles.velocity),
                       read_write(changes), read(grid.cell_start), read(particles.position)});
}

void Wind::record_step(gpu::Commands& commands, const Fluid& fluid, const gpu::Buffer& ledger) const
{
    const ParticleBuffers& particles = fluid.particles;
    const gpu::Scope scope(commands, "sand");
    commands.dispatch(hop_, particles.moving, gpu::NoPush{},
                      {read(fluid.params), read(params_buffer_), read(from_above_.params()), read(ground_),
                       read(particles.id), read_write(particles.attributes), read_write(particles.position),
                       read_write(particles.velocity), write(particles.density), read_write(rests_),
                       read_write(ledger)});
}

void Wind::spread_start(const gpu::Context& context, const Exposure& exposure) const
{
    constexpr float least_area = 0.3f; // d^2
    const float area = least_area * spacing_ * spacing_;
    const std::vector<glm::vec4> surfaces = exposure.download();
    std::vector<glm::vec2> damage(surfaces.size(), glm::vec2(0.0f));
    for (std::uint32_t id = 0; id < surfaces.size(); ++id) {
        damage[id].x = surfaces[id].w > area ? shared::random_share(id) : 0.0f;
    }
    gpu::upload<glm::vec2>(context, damage_, damage);
}

std::uint64_t Wind::device_bytes() const
{
    return visibility_.device_bytes() + from_above_.device_bytes() + params_buffer_.size() + ground_.size() +
           top_id_.size() + way_.size() + claim_.size() + damage_.size() + rests_.size();
}

} // namespace meltpoint::sim
