#include "validation/scene_run.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace meltpoint::validation {

std::string_view solver_name(Solver solver)
{
    return solver == Solver::Wcsph ? "wcsph" : solver == Solver::Dfsph ? "dfsph" : "pbf";
}

namespace {

const Host& running(const Host& host)
{
    check_stop(host);
    return host;
}

} // namespace

SceneRun::SceneRun(const Host& host, const Scene& scene, std::size_t samples)
    : SceneRun(running(host), scene, make_particles(scene, sim::Simulation::particle_limit(host.context)), samples)
{
}

SceneRun::SceneRun(const Host& host, const Scene& scene, ParticleSet particles, std::size_t samples)
    : host_(running(host)), particles_(std::move(particles)), settings_(fluid_settings(scene, particles_)),
      simulation_(host.context, particles_, settings_.simulation),
      statistics_(measure(particles_, simulation_.params())), first_potential_energy_(statistics_.potential_energy),
      lowest_energy_(energy()),
      progress_(fmt::format("{} {}", scene.name, solver_name(scene.solver)), samples, host.quiet)
{
}

void SceneRun::advance_by(double seconds)
{
    check_stop(host_);
    simulation_.advance_by(seconds);
    particles_ = simulation_.download();
    statistics_ = measure(particles_, simulation_.params());
    energy_rise_ = std::max(energy_rise_, energy() - lowest_energy_);
    lowest_energy_ = std::min(lowest_energy_, energy());
    density_errors_ += statistics_.fluid_part ? statistics_.fluid_part->density_error_mean : 0.0;
    ++looks_;
    progress_.advance(fmt::format("{} particles, {:.4g} s", particles_.size(), time()));
}

double SceneRun::energy() const
{
    return (statistics_.kinetic_energy + statistics_.potential_energy) / first_potential_energy_;
}

} // namespace meltpoint::validation
