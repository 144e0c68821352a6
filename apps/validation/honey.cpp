#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "scene/scene_file.h"
#include "validation/scene_run.h"

namespace meltpoint::validation {

namespace {

/// Where the thread meets the pile: the mean place of the particles that have slowed down to less than half of the
/// thread's speed since the moment before. By id, as both sets are.
glm::dvec3 contact_point(const ParticleSet& before, const ParticleSet& after, double speed)
{
    glm::dvec3 sum(0.0);
    double count = 0.0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        const double fell = -static_cast<double>(before.velocity[i].y);
        const double falls = -static_cast<double>(after.velocity[i].y);
        if (fell > 0.5 * speed && falls < 0.5 * speed && !shared::is_boundary(after.attributes[i])) {
            sum += glm::dvec3(after.position[i]);
            count += 1.0;
        }
    }
    return count > 0.0 ? sum / count : sum;
}

struct Thread {
    double speed = 0.0; ///< downward, m/s
    double width = 0.0; ///< square root of its cross section, m
};

/// Between two heights.
Thread measure_thread(const ParticleSet& set, double low, double high, double rest_density)
{
    double momentum = 0.0;
    double mass = 0.0;
    for (std::size_t i = 0; i < set.size(); ++i) {
        const auto y = static_cast<double>(set.position[i].y);
        if (y > low && y < high && !shared::is_boundary(set.attributes[i])) {
            momentum -= static_cast<double>(set.mass[i]) * static_cast<double>(set.velocity[i].y);
            mass += static_cast<double>(set.mass[i]);
        }
    }
    return {.speed = momentum / mass, .width = std::sqrt(mass / (rest_density * (high - low)))};
}

} // namespace

Outcome run_honey(const Host& host)
{
    const Scene scene = builtin_scene("honey");
    const double spacing = static_cast<double>(scene.particles.spacing);
    const double rest_density = static_cast<double>(scene.fluids.at(0).rest_density);
    const double viscosity = static_cast<double>(scene.fluids.at(0).viscosity.value_or(scene.physics.viscosity));
    constexpr double nozzle = 0.022; // m above the floor, its end
    SceneRun run(host, scene, scene.time.frames - 1);
    ParticleSet before = run.particles();
    double turned = 0.0; // rad
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    double last = 0.0;
    double most_one_way = 0.0;
    double least_width = std::numeric_limits<double>::infinity();
    plot::Curve turns{"contact point", {}};
    for (std::uint32_t frame = 1; frame < scene.time.frames; ++frame) {
        run.advance_by(1.0 / static_cast<double>(scene.time.frame_rate));
        const Thread thread = measure_thread(run.particles(), 0.6 * nozzle, nozzle, rest_density);
        const glm::dvec3 contact = contact_point(before, run.particles(), thread.speed);
        before = run.particles();
        if (std::hypot(contact.x, contact.z) < 2.0 * spacing) { // no direction to speak of
            continue;
        }
        const double angle = std::atan2(contact.z, contact.x);
        turned = turns.points.empty() ? 0.0 : turned + std::remainder(angle - last, 2.0 * std::numbers::pi);
        last = angle;
        lowest = std::min(lowest, turned);
        highest = std::max(highest, turned);
        most_one_way = std::max({most_one_way, turned - lowest, highest - turned});
        least_width = std::min(least_width, thread.width);
        turns.points.emplace_back(run.time(), turned / (2.0 * std::numbers::pi));
    }
    // The bound of a viscosity that is a force like the others.
    const double support = spacing * static_cast<double>(scene.particles.support_ratio);
    const double explicit_dt = 0.06 * rest_density * support * support / viscosity;
    const auto solves = run.simulation().take_viscosity_statistics();
    Outcome outcome;
    outcome.measurements = {
        at_least("turns of the contact point one way", most_one_way / (2.0 * std::numbers::pi), 3.0),
        at_least("width of the thread while it turns, spacings, least", least_width / spacing, 6.0),
        at_least("mean step, in the longest of explicit viscosity", run.mean_dt() / explicit_dt, 10.0),
        at_most("particles outside", static_cast<double>(run.outside()), 0.0),
        at_most("solves for viscosity that ended before their error was met",
                solves ? static_cast<double>(solves->unconverged) : std::numeric_limits<double>::quiet_NaN(), 0.0)};
    outcome.figures.push_back({"honey.svg",
                               {.title = "A thread of honey coils",
                                .x_label = "time, s",
                                .y_label = "turns of the contact point",
                                .curves = {turns},
                                .scale = plot::Scale::Linear}});
    return outcome;
}

} // namespace meltpoint::validation
