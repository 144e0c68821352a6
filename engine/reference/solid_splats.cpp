#include "reference/solid_splats.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel_for.h"
#include "geometry/tangent_frame.h"

namespace meltpoint::reference {

namespace {

double smooth_ramp(float from, float to, double x)
{
    const double low = static_cast<double>(from);
    const double t = std::clamp((x - low) / (static_cast<double>(to) - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// How far a front has come through the cell of particle i.
double front_progress(const shared::SolidSplatParams& splats, const State& state, const SplatSources& sources,
                      std::size_t i)
{
    const double duration = static_cast<double>(splats.front_time[shared::particle_material(state.attributes[i])]);
    if (sources.freed_at.empty() || duration <= 0.0) {
        return 0.0;
    }
    const double left = static_cast<double>(sources.freed_at[i]) - sources.time;
    return std::clamp(1.0 - left / duration, 0.0, 1.0);
}

double progress(const shared::SolidSplatParams& splats, const State& state, const SplatSources& sources, std::size_t i)
{
    const double latent_heat = static_cast<double>(splats.latent_heat[shared::particle_material(state.attributes[i])]);
    double progress = front_progress(splats, state, sources, i);
    if (!sources.enthalpy.empty() && latent_heat > 0.0) {
        progress = std::max(progress, std::clamp(sources.enthalpy[i] / latent_heat, 0.0, 1.0));
    }
    if (!sources.damage.empty()) {
        progress = std::max(progress, std::clamp(sources.damage[i], 0.0, 1.0));
    }
    return progress;
}

/// Of a particle's ball, but for what is too thin for a surface.
double ball_size(const shared::SolidSplatParams& splats, const State& state, const SplatSources& sources, std::size_t i)
{
    const std::uint32_t cause = shared::cause_of(state.attributes[i]);
    switch (shared::particle_state(state.attributes[i])) {
    case shared::STATE_SOLID:
        return front_progress(splats, state, sources, i);
    case shared::STATE_FLUID:
        return splats.blend_time > 0.0f && (cause == shared::CAUSE_MELT || cause == shared::CAUSE_HYDRAULIC)
                   ? smooth_ramp(0.0f, splats.blend_time, sources.time - static_cast<double>(sources.freed_at[i]))
                   : 1.0;
    case shared::STATE_DUST:
        return std::cbrt(state.density[i]);
    case shared::STATE_DEAD:
        return 0.0;
    default:
        return 1.0;
    }
}

struct Field {
    double filling = 0.0;     ///< c
    glm::dvec3 gradient{0.0}; ///< 1/m
    double fluid = 0.0;       ///< what fluid fills
};

Field field_at(const glm::dvec3& x, double spacing, const State& state, const std::vector<double>& left)
{
    const double reach = static_cast<double>(shared::SURFACE_SUPPORT) * spacing;
    const double scale = 21.0 / (2.0 * std::numbers::pi) * std::pow(spacing / reach, 3);
    Field field;
    for (std::size_t j = 0; j < state.size(); ++j) {
        const glm::dvec3 way = x - state.position[j];
        const double q = glm::length(way) / reach;
        if (q < 1.0) {
            const double shape = scale * std::pow(1.0 - q, 4) * (1.0 + 4.0 * q);
            const double solid = std::max(left[j], 0.0);
            field.filling += solid * shape;
            field.fluid += std::max(-left[j], 0.0) * shape;
            field.gradient -= 20.0 * scale * solid * std::pow(1.0 - q, 3) / (reach * reach) * way;
        }
    }
    return field;
}

/// Spacings: the depth at which a plane leaves so much of the kernel on its far side, found by halving.
double depth_below_surface(double filling)
{
    const double missing = std::max(std::min(filling, 1.0 - filling), 1e-4);
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < 60; ++i) {
        const double u = 0.5 * (low + high);
        const bool too_much = std::pow(u, 6) * (3.5 - 4.5 * u + 1.5 * u * u) > missing;
        (too_much ? high : low) = u;
    }
    const double depth = static_cast<double>(shared::SURFACE_SUPPORT) * (1.0 - low);
    return filling > 0.5 ? depth : -depth;
}

/// How the normals of discs around one turn, as the tangents of its normal have it: the symmetric part of the map that
/// fits them best.
glm::dvec3 bend(const std::vector<Disc>& discs, const State& state, std::size_t i, double spacing)
{
    const double reach = static_cast<double>(shared::BEND_REACH) * spacing;
    const double radius = static_cast<double>(shared::PARTICLE_SPLAT_RADIUS) * spacing;
    const TangentFrame frame(discs[i].normal);
    glm::dmat2 ways(static_cast<double>(shared::FLATNESS) * radius * spacing * spacing);
    glm::dmat2 turns(0.0);
    for (std::size_t j = 0; j < discs.size(); ++j) {
        const glm::dvec3 way = discs[j].center - discs[i].center;
        const double apart = glm::distance(state.position[i], state.position[j]);
        const double share = 1.0 - apart * apart / (reach * reach);
        const double alike = glm::dot(discs[j].normal, discs[i].normal);
        if (discs[j].radius > 0.0 && share > 0.0 && alike > 0.0) {
            const double weight = discs[j].radius * share * alike;
            const glm::dvec2 at(glm::dot(way, frame.u), glm::dot(way, frame.v));
            const glm::dvec2 turn(glm::dot(discs[j].normal, frame.u), glm::dot(discs[j].normal, frame.v));
            ways += weight * glm::outerProduct(at, at);
            turns += weight * glm::outerProduct(turn, at);
        }
    }
    const glm::dmat2 map = turns * glm::inverse(ways);
    const double most = static_cast<double>(shared::MOST_BEND) / radius;
    return glm::clamp(glm::dvec3(map[0][0], 0.5 * (map[0][1] + map[1][0]), map[1][1]), -most, most);
}

/// Whether its hosts have parted.
bool is_torn(const shared::HostedSplat& splat, const State& state)
{
    const glm::dvec3 a = state.position[splat.host.x];
    const glm::dvec3 b = state.position[splat.host.y];
    const glm::dvec3 c = state.position[splat.host.z];
    const double stretch = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    return stretch > static_cast<double>(shared::MOST_STRETCH * splat.span);
}

/// What was so wet before is after some seconds, where fluid fills so much around it.
double wetness_after(double seconds, double before, double fluid)
{
    const double target = std::min(fluid / static_cast<double>(shared::WET_FILLING), 1.0);
    const float time = target > before ? shared::WETTING_TIME : shared::DRYING_TIME;
    return target + (before - target) * std::exp(-seconds / static_cast<double>(time));
}

/// Its disc, and what it keeps.
Disc hosted_disc(const shared::HostedSplat& splat, double spacing, const State& state, const SolidSplats& found,
                 double seconds, KeptOfHosted& kept)
{
    const glm::dvec3 a = state.position[splat.host.x];
    const glm::dvec3 first = state.position[splat.host.y] - a;
    const glm::dvec3 second = state.position[splat.host.z] - a;
    const glm::dmat3 frame(first, second, glm::cross(first, second) / spacing);
    double mean = 0.0;
    double worst = 0.0; // of the first host to go
    for (int k = 0; k < 3; ++k) {
        const double progress = 1.0 - std::max(found.left[splat.host[k]], 0.0);
        mean += static_cast<double>(splat.weight[k]) * progress;
        worst = std::max(worst, progress);
    }
    const double recession = static_cast<double>(shared::RECESSION) * spacing * mean;
    const glm::dvec3 normal = glm::normalize(frame * glm::dvec3(splat.normal));
    const glm::dvec3 center = a + frame * glm::dvec3(splat.offset) - recession * normal;

    const bool is_still = kept.start > 0.0 && worst == 0.0 && kept.wet == 0.0 && !found.changed[splat.host.x] &&
                          !found.changed[splat.host.y] && !found.changed[splat.host.z];
    const Field field = is_still ? Field{.filling = kept.start} : field_at(center, spacing, state, found.left);
    kept.start = kept.start > 0.0 ? kept.start : std::max(field.filling, 1e-6);
    kept.wet = wetness_after(seconds, kept.wet, field.fluid);
    const double bare = 1.0 - smooth_ramp(shared::BARE_FULLY, shared::BARE_FROM, field.filling / kept.start);
    const double sinking = std::max(smooth_ramp(shared::SINKING_FROM, shared::SINKING_UNTIL, worst), bare);
    kept.gone = kept.gone || worst >= 1.0 || is_torn(splat, state);
    kept.cover = kept.gone ? 0.0 : 1.0 - sinking;
    const glm::dvec3 up = -field.gradient / std::max(glm::length(field.gradient), 1e-6);
    const double area = -2.0 * spacing * glm::dot(field.gradient, normal); // A / d^2, seen along its normal
    const double facing = smooth_ramp(0.0f, shared::EXPOSED_FROM, area);
    const double turning = sinking * facing;
    const double rise =
        depth_below_surface(field.filling) - static_cast<double>(shared::PARTICLE_SPLAT_DEPTH + shared::SINKING_DEPTH);
    const double part_left = // all of it where there is something to sink to
        (1.0 - smooth_ramp(shared::SHRINKING_FROM, 1.0f, worst)) * (1.0 - bare * (1.0 - facing));
    return {.center = center + turning * std::clamp(rise, -1.0, 1.0) * spacing * up,
            .radius = kept.gone ? 0.0 : static_cast<double>(splat.radius) * part_left,
            .normal = glm::normalize(glm::mix(normal, up, turning)),
            .color = glm::dvec3(splat.color) * (1.0 + kept.wet * (static_cast<double>(splat.wet_albedo) - 1.0)),
            .bend = frame * glm::dvec3(splat.edge),
            .edge = static_cast<double>(splat.edge_distance) - recession,
            .wet = kept.wet};
}

} // namespace

SolidSplats solid_splats(const Settings& settings, const shared::SolidSplatParams& splats, const State& state,
                         const SplatSources& sources, const SolidSplats& before)
{
    const double spacing = static_cast<double>(settings.params.spacing);
    SolidSplats found{.left = std::vector<double>(state.size()),
                      .size = std::vector<double>(state.size()),
                      .wet = before.wet,
                      .start = before.start,
                      .changed = before.changed,
                      .kept = before.kept,
                      .particle = std::vector<Disc>(state.size())};
    found.wet.resize(state.size(), 0.0);
    found.start.resize(state.size(), 0.0);
    found.changed.resize(state.size(), false);
    found.kept.resize(sources.hosted.size());
    for (std::size_t i = 0; i < state.size(); ++i) {
        const std::uint32_t its_state = shared::particle_state(state.attributes[i]);
        found.left[i] = its_state == shared::STATE_SOLID   ? 1.0 - progress(splats, state, sources, i)
                        : its_state == shared::STATE_FLUID ? -1.0
                                                           : 0.0;
        found.size[i] = ball_size(splats, state, sources, i);
    }
    for (std::size_t k = 0; k < sources.hosted.size(); ++k) {
        found.hosted.push_back(hosted_disc(sources.hosted[k], spacing, state, found, sources.seconds, found.kept[k]));
    }
    std::vector<std::uint8_t> changed(state.size(), 0);
    parallel_for(state.size(), [&](std::size_t i) {
        if (found.left[i] <= 0.0) {
            return;
        }
        const Field field = field_at(state.position[i], spacing, state, found.left);
        const double steepness = glm::length(field.gradient);
        const double exposed = smooth_ramp(shared::EXPOSED_FROM, shared::EXPOSED_FULLY, 2.0 * spacing * steepness);
        const double thin = (1.0 - exposed) * (1.0 - smooth_ramp(shared::THIN_FULLY, shared::THIN_FROM, field.filling));
        const double living = 1.0 - smooth_ramp(shared::DYING_FROM, 1.0f, 1.0 - found.left[i]);
        found.size[i] = std::max(found.size[i], thin * living);
        found.start[i] = found.start[i] > 0.0 ? found.start[i] : field.filling;
        const double part_left = field.filling / found.start[i];
        changed[i] = std::abs(part_left - 1.0) > static_cast<double>(shared::UNCHANGED) || field.fluid > 0.0 ? 1 : 0;
        if (exposed <= 0.0) {
            return;
        }
        const double eroded = smooth_ramp(shared::ERODED_FROM, shared::ERODED_FULLY, 1.0 - part_left);
        found.wet[i] = wetness_after(sources.seconds, found.wet[i], field.fluid);

        const std::uint32_t material = shared::particle_material(state.attributes[i]);
        const std::uint32_t cover = sources.cover[i];
        const bool has_cover = cover != shared::NO_COVER;
        const double covered = has_cover ? found.kept[cover].cover : 0.0;
        const double backing = covered * (1.0 - eroded);
        const bool at_edge = has_cover && static_cast<double>(sources.hosted[cover].edge_distance) <
                                              static_cast<double>(shared::BACKING_REACH) * spacing;
        const double depth = depth_below_surface(field.filling) - static_cast<double>(shared::PARTICLE_SPLAT_DEPTH) -
                             static_cast<double>(shared::COVERED_DEPTH) * covered -
                             static_cast<double>(shared::BACKING_DEPTH) * backing;
        Disc& disc = found.particle[i];
        disc.normal = -field.gradient / steepness;
        disc.center = state.position[i] + depth * spacing * disc.normal;
        disc.radius = glm::mix(static_cast<double>(shared::PARTICLE_SPLAT_RADIUS),
                               static_cast<double>(at_edge ? shared::BACKING_RADIUS : 0.0f), backing) *
                      spacing * exposed * living;
        disc.wet = found.wet[i];
        disc.color = glm::dvec3(splats.color[material]) *
                     (1.0 + disc.wet * (static_cast<double>(splats.wet_albedo[material]) - 1.0));
    });
    found.changed.assign(changed.begin(), changed.end());
    parallel_for(state.size(), [&](std::size_t i) {
        if (found.particle[i].radius > 0.0) {
            found.particle[i].bend = bend(found.particle, state, i, spacing);
        }
    });
    return found;
}

} // namespace meltpoint::reference
