#include "run/emission_settings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.h"
#include "core/overloaded.h"
#include "geometry/plane_sampling.h"
#include "geometry/tangent_frame.h"
#include "scene/scene_check.h"

namespace meltpoint {

namespace {

double cell_volume(const Scene& scene)
{
    return std::pow(static_cast<double>(scene.particles.spacing), scene.domain.dimensions);
}

/// Points of a line of that length around its center, a spacing apart or nearly so.
std::vector<glm::vec3> line_points(const glm::vec3& center, const glm::vec3& direction, double length, double spacing)
{
    const double count = std::max(std::round(length / spacing), 1.0);
    std::vector<glm::vec3> points;
    for (double i = 0.5; i < count; ++i) {
        points.push_back(center + direction * static_cast<float>(length * (i / count - 0.5)));
    }
    return points;
}

/// A layer of an emitter: its points (m), and the area that they stand for (m^2; in two dimensions a length in m).
struct Layer {
    std::vector<glm::vec3> points;
    double area = 0.0;
    double speed = 0.0; ///< m/s, through it
};

Layer make_layer(const Scene& scene, const EmitterBody& emitter, const JetShape& jet)
{
    const double spacing = static_cast<double>(scene.particles.spacing);
    const double radius = static_cast<double>(jet.radius);
    const double speed = static_cast<double>(glm::length(emitter.velocity));
    const glm::vec3 ahead = glm::normalize(emitter.velocity);
    if (scene.domain.dimensions == 2) {
        return {line_points(jet.center, {-ahead.y, ahead.x, 0.0f}, 2.0 * radius, spacing), 2.0 * radius, speed};
    }
    const TangentFrame frame{glm::dvec3(ahead)};
    Layer layer{{}, 3.141592653589793 * radius * radius, speed};
    for (const glm::vec3& p : sample_disk(glm::vec2(0.0f), radius, spacing).positions) {
        const glm::dvec3 across = static_cast<double>(p.x) * frame.u + static_cast<double>(p.y) * frame.v;
        layer.points.push_back(jet.center + glm::vec3(across));
    }
    return layer;
}

Layer make_layer(const Scene& scene, const EmitterBody& emitter, const InflowShape& inflow)
{
    const double spacing = static_cast<double>(scene.particles.spacing);
    const bool flat = scene.domain.dimensions == 2;
    const int axis = flat_axis(inflow, flat).value();
    const double speed = std::abs(static_cast<double>(emitter.velocity[axis]));
    const glm::vec3 size = inflow.max - inflow.min;
    if (flat) {
        glm::vec3 along(0.0f);
        along[1 - axis] = 1.0f;
        const double length = static_cast<double>(size[1 - axis]);
        return {line_points(0.5f * (inflow.min + inflow.max), along, length, spacing), length, speed};
    }
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    Layer layer{{}, static_cast<double>(size[u]) * static_cast<double>(size[v]), speed};
    const VolumeSamples samples =
        sample_rectangle({inflow.min[u], inflow.min[v]}, {inflow.max[u], inflow.max[v]}, spacing);
    for (const glm::vec3& p : samples.positions) {
        glm::vec3 place = inflow.min;
        place[u] = p.x;
        place[v] = p.y;
        layer.points.push_back(place);
    }
    return layer;
}

/// All but its slots.
template <class LayeredShape>
void plan(const Scene& scene, const EmitterBody& body, const LayeredShape& shape, shared::Emitter& emitter,
          std::vector<glm::vec3>& points)
{
    const Layer layer = make_layer(scene, body, shape);
    const double count = static_cast<double>(layer.points.size());
    emitter.period = static_cast<float>(count * cell_volume(scene) / (layer.area * layer.speed));
    emitter.points = static_cast<std::uint32_t>(layer.points.size());
    points.insert(points.end(), layer.points.begin(), layer.points.end());
}

void plan(const Scene& scene, const EmitterBody& body, const RainShape& rain, shared::Emitter& emitter,
          std::vector<glm::vec3>& points)
{
    emitter.period = static_cast<float>(emitted_mass(scene, body) / static_cast<double>(rain.rate));
    emitter.points = 1;
    emitter.spread = rain.max - rain.min;
    emitter.jitter = 1.0f;
    points.push_back(rain.min);
}

/// Births before a time, s since the start of the run.
double births_before(const shared::Emitter& emitter, double time)
{
    const double layers = std::ceil((time - static_cast<double>(emitter.start)) / static_cast<double>(emitter.period));
    return std::max(layers, 0.0) * static_cast<double>(emitter.points);
}

} // namespace

double emitted_mass(const Scene& scene, const EmitterBody& emitter)
{
    return static_cast<double>(emitter.fluid.rest_density) * cell_volume(scene);
}

sim::EmissionSettings emission_settings(const Scene& scene, std::uint32_t first_id)
{
    constexpr double most = std::numeric_limits<std::uint32_t>::max();
    constexpr double most_slots = 1u << 30;
    const double run_time = (scene.time.frames - 1) / static_cast<double>(scene.time.frame_rate);
    sim::EmissionSettings settings;
    for (std::size_t e = 0; e < scene.emitters.size(); ++e) {
        const EmitterBody& body = scene.emitters[e];
        shared::Emitter emitter{.velocity = body.velocity,
                                .start = body.start,
                                .first_point = static_cast<std::uint32_t>(settings.points.size()),
                                .first_id = first_id,
                                .seed = static_cast<std::uint32_t>(scene.seed * 64 + 4 * e)};
        std::visit([&](const auto& shape) { plan(scene, body, shape, emitter, settings.points); }, body.shape);
        const double end = body.stop ? static_cast<double>(*body.stop) : std::numeric_limits<double>::infinity();
        const double births = std::min(births_before(emitter, end), most);
        const double slots = std::max(
            std::min(births, body.particles ? *body.particles : births_before(emitter, run_time) + emitter.points),
            1.0);
        if (slots > most_slots) {
            throw input_error("{}: emitter.{} would bring about {:.3g} particles in the {:.4g} s of the run: give it "
                              "fewer with emitter.{}.particles",
                              scene.name, e, slots, run_time, e);
        }
        emitter.births = static_cast<std::uint32_t>(births);
        emitter.slots = static_cast<std::uint32_t>(slots);
        first_id += emitter.slots;
        settings.emitters.push_back(emitter);
    }
    for (const SinkBody& body : scene.sinks) {
        settings.sinks.push_back(
            std::visit(Overloaded{
                           [](const BlockShape& block) {
                               return shared::Sink{.low = block.min, .shape = shared::SINK_BLOCK, .high = block.max};
                           },
                           [](const SphereShape& ball) {
                               return shared::Sink{
                                   .low = ball.center, .shape = shared::SINK_SPHERE, .high = glm::vec3(ball.radius)};
                           },
                       },
                       body.shape));
    }
    return settings;
}

sim::EmissionSettings emission_settings(const Scene& scene, const ParticleSet& particles)
{
    const auto first = std::ranges::find_if(particles.attributes, shared::is_gone);
    return emission_settings(scene, static_cast<std::uint32_t>(first - particles.attributes.begin()));
}

} // namespace meltpoint
