#include "bench/pace.h"

#include "bench/clock.h"
#include "bench/measurement.h"

namespace meltpoint::bench {

Pace measure_pace(const gpu::Context& context, const ParticleSet& initial, const sim::SimulationSettings& settings,
                  double seconds)
{
    constexpr int looks = 30;
    sim::Simulation simulation(context, initial, settings);
    simulation.advance(1); // compiles the shaders, outside of the measurement
    const double started_at = simulation.time();
    Pace pace;
    double milliseconds = 0.0;
    for (int i = 0; i < looks; ++i) {
        const double before = device_milliseconds(context.info());
        simulation.advance_by(seconds / looks);
        milliseconds += device_milliseconds(context.info()) - before;
        pace.density_error += mean_density_error(simulation.download(), simulation.params()) / looks;
    }
    pace.simulated_seconds_per_second = (simulation.time() - started_at) / milliseconds * 1e3;
    pace.dt = simulation.time() / static_cast<double>(simulation.step());
    if (const auto solves = simulation.take_solve_statistics()) {
        pace.iterations = (*solves)[shared::SOLVE_DENSITY].mean_iterations;
    }
    return pace;
}

} // namespace meltpoint::bench
