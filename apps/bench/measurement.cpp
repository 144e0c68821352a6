#include "bench/measurement.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "bench/clock.h"
#include "bench/yardstick.h"
#include "core/error.h"
#include "core/log.h"
#include "shared/particle_state.h"

namespace meltpoint::bench {

namespace {

constexpr std::uint32_t most_portions = 7;

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) {
        return *middle;
    }
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// How many of `steps` belong to each portion: as equal as can be, none empty.
std::vector<std::uint32_t> portions(std::uint32_t steps)
{
    const std::uint32_t count = std::min(steps, most_portions);
    std::vector<std::uint32_t> sizes;
    for (std::uint32_t i = 0; i < count; ++i) {
        sizes.push_back(steps * (i + 1) / count - steps * i / count);
    }
    return sizes;
}

/// One of the things that take turns: a simulation or the yardstick.
template <class Clock, class Advance>
double milliseconds_a_step(const Clock& clock, std::uint32_t steps, const Advance& advance)
{
    const double start = clock();
    advance(steps);
    return (clock() - start) / steps;
}

std::vector<std::pair<std::string, double>> pass_times(sim::Simulation& simulation, std::uint32_t steps)
{
    simulation.enable_timings();
    simulation.advance(steps);
    std::vector<std::pair<std::string, double>> passes;
    for (const gpu::Timing& timing : simulation.timings()) {
        passes.emplace_back(timing.name, timing.milliseconds / std::max(timing.count, 1u));
    }
    return passes;
}

void scale_to(std::vector<std::pair<std::string, double>>& passes, double step_ms)
{
    const double sum =
        std::accumulate(passes.begin(), passes.end(), 0.0, [](double s, const auto& pass) { return s + pass.second; });
    for (auto& [name, milliseconds] : passes) {
        milliseconds *= sum > 0.0 ? step_ms / sum : 0.0;
    }
}

struct Totals {
    glm::dvec3 center{0.0};
    double kinetic_energy = 0.0;
};

Totals totals(const ParticleSet& set)
{
    Totals sum;
    double mass = 0.0;
    for (std::size_t i = 0; i < set.size(); ++i) {
        const auto m = static_cast<double>(set.mass[i]);
        const glm::dvec3 v(set.velocity[i]);
        sum.center += m * glm::dvec3(set.position[i]);
        sum.kinetic_energy += 0.5 * m * glm::dot(v, v);
        mass += m;
    }
    sum.center /= mass;
    return sum;
}

/// The yardstick's density at the simulation's positions.
void require_same_density(const ParticleSet& device, const ParticleSet& yardstick)
{
    constexpr double bound = 1e-5;
    double error = 0.0;
    for (std::size_t i = 0; i < device.size(); ++i) {
        const auto rho = static_cast<double>(device.density[i]);
        error += std::abs(static_cast<double>(yardstick.density[i]) - rho) / rho;
    }
    error /= static_cast<double>(device.size());
    if (!(error <= bound)) {
        throw runtime_error("the yardstick's density is {:.2g} off the device's, more than {:.0g}: they do not compute "
                            "the same",
                            error, bound);
    }
}

/// After the same steps from the same state.
void require_same_motion(const ParticleSet& device, const ParticleSet& yardstick, const shared::SphParams& params)
{
    constexpr double bound = 1e-3;
    const Totals a = totals(device);
    const Totals b = totals(yardstick);
    const double size = glm::length(glm::dvec3(params.domain_max) - glm::dvec3(params.domain_min));
    const double center_error = glm::length(a.center - b.center) / size;
    const double energy_error = std::abs(a.kinetic_energy - b.kinetic_energy) / std::max(a.kinetic_energy, 1e-30);
    if (!(center_error <= bound) || !(energy_error <= 10.0 * bound)) {
        throw runtime_error("after the same steps the yardstick's center of mass is {:.2g} of the domain off the "
                            "device's and its kinetic energy {:.2g}: they do not compute the same",
                            center_error, energy_error);
    }
}

std::unique_ptr<Yardstick> make_yardstick(const ParticleSet& state, const shared::SphParams& params,
                                          const sim::FluidOptions& options)
{
    if (options.mixed_viscosity) {
        log_warning("the yardstick knows one viscosity: this scene is measured without it");
        return nullptr;
    }
    if (options.dimensions != 3 || params.periodic_mask != 0 || params.lid_velocity != glm::vec3(0.0f)) {
        log_warning("the yardstick knows three dimensions and walls at rest alone: this scene is measured without it");
        return nullptr;
    }
    if (options.shifting) {
        log_warning("the yardstick shifts no particles: this scene is measured without it");
        return nullptr;
    }
    if (options.tension || options.capillarity) {
        log_warning("the yardstick has no surface tension: this scene is measured without it");
        return nullptr;
    }
    if (options.solver != shared::SOLVER_WCSPH) {
        log_warning("the yardstick is weakly compressible: this scene is measured without it");
        return nullptr;
    }
    if (options.implicit_viscosity) {
        log_warning("the yardstick's viscosity is explicit: this scene is measured without it");
        return nullptr;
    }
    if (std::ranges::any_of(state.attributes, shared::is_boundary)) {
        log_warning("the yardstick has no colliders: this scene is measured without it");
        return nullptr;
    }
    const std::string missing = Yardstick::missing_feature();
    if (!missing.empty()) {
        log_warning(fmt::format("the yardstick was compiled for processors with {}, which this one has not", missing));
        return nullptr;
    }
    auto yardstick = std::make_unique<Yardstick>(state, params, options.kernel, processors());
    yardstick->evaluate_density();
    require_same_density(state, yardstick->particles());
    return yardstick;
}

} // namespace

double mean_density_error(const ParticleSet& set, const shared::SphParams& params)
{
    double sum = 0.0;
    std::size_t fluid = 0;
    for (std::size_t i = 0; i < set.size(); ++i) {
        if (shared::particle_state(set.attributes[i]) == shared::STATE_FLUID) {
            const float rest_density = params.rest_density[shared::particle_material(set.attributes[i])];
            sum += std::max(static_cast<double>(set.density[i] / rest_density) - 1.0, 0.0);
            ++fluid;
        }
    }
    return fluid > 0 ? sum / static_cast<double>(fluid) : 0.0;
}

std::vector<Result> measure(const gpu::Context& context, const ParticleSet& initial,
                            const sim::SimulationSettings& settings, const Plan& plan)
{
    // All start from the state that the first leaves after the warm-up.
    std::vector<std::unique_ptr<sim::Simulation>> simulations;
    ParticleSet warm;
    for (const std::uint32_t tile : plan.tiles) {
        sim::SimulationSettings of_tile = settings;
        of_tile.options.tile = tile;
        simulations.push_back(
            std::make_unique<sim::Simulation>(context, simulations.empty() ? initial : warm, of_tile));
        if (simulations.size() == 1) {
            simulations[0]->advance(plan.warm_up);
            warm = simulations[0]->download();
        }
        simulations.back()->advance(1); // compiles the shaders, outside of the measurement
    }
    warm = simulations[0]->download();
    const shared::SphParams& params = simulations[0]->params();
    const std::unique_ptr<Yardstick> yardstick =
        plan.own_steps ? nullptr : make_yardstick(warm, params, settings.options);

    const auto device_clock = [&] {
        return device_milliseconds(context.info());
    };
    std::vector<std::vector<double>> times(simulations.size());
    std::vector<double> yardstick_times;
    std::vector<double> started_at;
    for (const auto& simulation : simulations) {
        started_at.push_back(simulation->time());
        (void)simulation->take_solve_statistics();
    }
    for (const std::uint32_t steps : portions(plan.steps)) {
        for (std::size_t i = 0; i < simulations.size(); ++i) {
            const auto advance = [&](std::uint32_t count) {
                simulations[i]->advance(count);
            };
            times[i].push_back(milliseconds_a_step(device_clock, steps, advance));
        }
        if (yardstick) {
            const auto advance = [&](std::uint32_t count) {
                yardstick->advance(count);
            };
            yardstick_times.push_back(milliseconds_a_step(processor_milliseconds, steps, advance));
        }
    }
    if (yardstick) {
        require_same_motion(simulations[0]->download(), yardstick->particles(), params);
    }

    std::vector<Result> results;
    for (std::size_t i = 0; i < simulations.size(); ++i) {
        Result result;
        result.particles = params.pool_count;
        result.tile = simulations[i]->tile();
        result.neighbors = simulations[i]->neighbor_statistics().mean;
        result.steps = plan.steps;
        result.step_ms = median(times[i]);
        result.dt = (simulations[i]->time() - started_at[i]) / plan.steps;
        result.density_error = mean_density_error(simulations[i]->download(), params);
        if (const auto solves = simulations[i]->take_solve_statistics()) {
            result.iterations = (*solves)[shared::SOLVE_DENSITY].mean_iterations;
        }
        result.bytes = simulations[i]->device_bytes();
        if (yardstick) {
            result.yardstick_step_ms = median(yardstick_times);
        }
        result.passes = pass_times(*simulations[i], std::min(plan.steps, most_portions));
        if (context.info().software()) {
            scale_to(result.passes, result.step_ms);
        }
        results.push_back(std::move(result));
    }
    return results;
}

} // namespace meltpoint::bench
