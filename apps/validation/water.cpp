#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "geometry/nearest_points.h"
#include "scene/liquids.h"
#include "validation/scene_run.h"

namespace meltpoint::validation {

namespace {

constexpr std::size_t samples = 100;
constexpr double seconds = 5.0;

/// Water half a meter high, let go at one end of a tank 1.5 m long.
Scene water_scene(Solver solver, float support_ratio)
{
    Scene scene;
    scene.name = "water";
    scene.solver = solver;
    scene.domain.min = glm::vec3(0.0f);
    scene.domain.max = glm::vec3(1.5f, 1.0f, 0.25f);
    scene.particles.spacing = 0.025f;
    scene.particles.support_ratio = support_ratio;
    scene.time.frame_rate = static_cast<float>(samples / seconds);
    FluidBody water{.shape = BlockShape{glm::vec3(0.0f), glm::vec3(0.5f, 0.5f, 0.25f)}};
    set_liquid(water, *find_liquid("water"));
    scene.fluids.push_back(water);
    return scene;
}

/// The part of the particles whose nearest neighbor is nearer than half a spacing: they clump.
double clumped(const ParticleSet& set, float spacing)
{
    const NearestPoints points(set.position);
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < set.size(); ++i) {
        const std::uint32_t nearest = points.of(i, 1).at(0);
        count += glm::distance(set.position[i], set.position[nearest]) < 0.5f * spacing ? 1 : 0;
    }
    return static_cast<double>(count) / static_cast<double>(set.size());
}

} // namespace

Outcome run_water(const Host& host)
{
    Outcome outcome;
    plot::LinePlot plot{.title = "Water, half a meter high: its energy",
                        .x_label = "time, s",
                        .y_label = "energy, of the first potential energy",
                        .curves = {},
                        .scale = plot::Scale::Linear};
    for (const float support_ratio : {2.0f, 3.0f}) {
        const Scene scene = water_scene(Solver::Dfsph, support_ratio);
        const std::string what = fmt::format("dfsph, H = {:g} d: ", support_ratio);
        SceneRun run(host, scene, samples);
        plot::Curve energy{fmt::format("H = {:g} d", support_ratio), {{0.0, run.energy()}}};
        double most_clumped = 0.0;
        for (std::size_t i = 0; i < samples; ++i) {
            run.advance_by(seconds / samples);
            energy.points.emplace_back(run.time(), run.energy());
            most_clumped = std::max(most_clumped, clumped(run.particles(), scene.particles.spacing));
        }
        const Scene weakly_compressible = water_scene(Solver::Wcsph, support_ratio);
        const double wcsph_dt = static_cast<double>(
            with_fixed_steps(
                fluid_settings(weakly_compressible, make_particles(weakly_compressible, 1'000'000)).simulation)
                .params.dt);
        outcome.measurements.push_back(at_most(what + "energy above its lowest value before", run.energy_rise(), 0.01));
        outcome.measurements.push_back(at_most(what + "mean density error", run.density_error(), 0.001));
        outcome.measurements.push_back(at_most(what + "particles outside", static_cast<double>(run.outside()), 0.0));
        if (support_ratio < 2.5f) {
            // Splashing water with wide kernels pairs up whatever the solver: a density over a hundred neighbors does
            // not tell one place from two.
            outcome.measurements.push_back(
                at_most(what + "particles nearer than d/2 to another, most at a time", most_clumped, 0.05));
        }
        outcome.measurements.push_back(at_least(what + "mean step, in steps of wcsph", run.mean_dt() / wcsph_dt, 3.0));
        plot.curves.push_back(energy);
    }
    outcome.figures.push_back({"water.svg", plot});
    return outcome;
}

} // namespace meltpoint::validation
